#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/stars/search/patch_search.h"
#include "render/backend/buffer.h"
#include "render/passes/stars/image_observer.h"
#include "render/passes/stars/search/image_joiner.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/search/view_cone.h"

namespace ergodome {

//! Copies of arrays in a backend's memory. The memory is reused for the next set of arrays.
class PlacedArrays {
 public:
  explicit PlacedArrays(Backend backend) : backend_(backend) {}

  //! Starts a new set, whose arrays overwrite the previous ones in order.
  void begin() { next_ = 0; }

  //! Copies `values` and returns the address of the copy, valid until begin().
  template <class T>
  const T* put(const std::vector<T>& values) {
    if (next_ == memory_.size()) {
      memory_.emplace_back();
    }
    Buffer<std::byte>& buffer = memory_[next_++];
    reserve(backend_, values.size() * sizeof(T), "star search", buffer);
    buffer.write(reinterpret_cast<const std::byte*>(values.data()), values.size() * sizeof(T));
    return reinterpret_cast<const T*>(buffer.data());
  }

 private:
  Backend backend_;
  std::vector<Buffer<std::byte>> memory_;
  std::size_t next_ = 0;
};

//! Star patches in the memory that a search reads.
class PlacedPatches {
 public:
  //! `station`: the lens station from which the patches were computed.
  PlacedPatches(Backend backend, const StarPatches& patches, const LensStation& station) : arrays_(backend) {
    set(patches, station);
  }

  //! Replaces the patches.
  void set(const StarPatches& patches, const LensStation& station);

  //! Returns a batch with the patches, without the parameters of a search.
  [[nodiscard]] const PatchSearchBatch& batch() const { return batch_; }

 private:
  PlacedArrays arrays_;
  PatchSearchBatch batch_{};
};

//! The GPU's driver of the search: finds the same images as RoughImageFinder, in nondeterministic
//! order.
class PatchSearch {
 public:
  //! `colours` must be in host memory. `room`: initial capacity of each list: of pairs, images and
  //! parts.
  PatchSearch(Backend backend, const StarField& field, const BlackbodyTable& colours, int room = 1 << 16);

  [[nodiscard]] Backend backend() const { return backend_; }

  //! Parameters of a search: the eye, and which images are wanted.
  struct Request {
    double phi;  //!< azimuth of the camera [rad]
    ViewCone view;
    const ImageObserver& observer;
    StarAppearance appearance;
  };

  //! Result of a search: approximate images, and images so accurate that they need no rays. The
  //! latter stay in GPU memory until the next search.
  struct Result {
    std::vector<RoughImage> rough;
    BackendImages exact;
  };

  //! Finds the images in patches, which must have been computed for the star field of this object.
  Result find(const PlacedPatches& patches, const Request& request);

 private:
  //! The lists in GPU memory whose lengths kernels count; `lost_parts` counts parts for which there
  //! was no room.
  enum List { regular, bent, folded, images, exact, halved, halves, last_regular, last_folded, lost_parts, list_count };
  using Counts = std::array<std::int32_t, list_count>;

  [[nodiscard]] Counts counts() const;
  void make_room(const Counts& wanted);
  void share(PatchSearchBatch& batch) const;
  [[nodiscard]] bool have_room(const Counts& counts) const;
  Counts search(PatchSearchBatch batch);
  void run(PatchSearchBatch& batch, PatchSearchStep step, int count, int depth = 0) const;
  void search_slice(PatchSearchBatch batch, int pairs);

  Backend backend_;
  PlacedArrays arrays_;
  SearchedField field_;
  BlackbodyTable colours_;
  Counts rooms_{};  //!< capacities of the lists
  Buffer<SearchedPair> pairs_[3];
  Buffer<RoughImage> images_;
  Buffer<SeenImage> exact_;
  Buffer<float> parts_[4];
  Buffer<FoldedRoot> regular_roots_;
  Buffer<FoldedRoot> folded_roots_;
  Buffer<FoldedRoot> roots_;
  Buffer<std::int32_t> root_counts_;
  Buffer<std::int32_t> root_first_;
  Buffer<std::int32_t> counts_;
};

}  // namespace ergodome
