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

//! Copies of arrays in a backend's memory, which is kept for those of the next time.
class PlacedArrays {
 public:
  explicit PlacedArrays(Backend backend) : backend_(backend) {}

  //! From now on arrays take the places of those before, one after another.
  void begin() { next_ = 0; }

  //! Where a copy of `values` lies, until begin().
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

//! Patches where a search reads them.
class PlacedPatches {
 public:
  //! `station`: which they were made of.
  PlacedPatches(Backend backend, const StarPatches& patches, const LensStation& station) : arrays_(backend) {
    set(patches, station);
  }

  //! Others, in the place of those.
  void set(const StarPatches& patches, const LensStation& station);

  //! Without what a search is for.
  [[nodiscard]] const PatchSearchBatch& batch() const { return batch_; }

 private:
  PlacedArrays arrays_;
  PatchSearchBatch batch_{};
};

//! Finds images of stars roughly, on a device: what RoughImageFinder finds, in an order that chance decides.
class PatchSearch {
 public:
  //! `colours` in host memory. `room`: for pairs and images at first.
  PatchSearch(Backend backend, const StarField& field, const BlackbodyTable& colours, int room = 1 << 16);

  [[nodiscard]] Backend backend() const { return backend_; }

  //! What is asked of a search.
  struct Question {
    double phi;  //!< of the camera [rad]
    ViewCone view;
    const ImageObserver& observer;
    StarLook look;
  };

  //! What it finds: rough images, and those that need no rays, which stay in place until the next search.
  struct Answer {
    std::vector<RoughImage> rough;
    FoundInPlace exact;
  };

  //! Patches are of this field.
  Answer find(const PlacedPatches& patches, const Question& question);

  //! What stays in place, in host memory.
  [[nodiscard]] std::vector<SeenImage> fetched(const FoundInPlace& found) const;

 private:
  //! Lists whose lengths the device counts.
  enum List { regular, bent, folded, images, exact, halved, halves, plain_parts, folded_parts, lost_parts, list_count };
  using Counts = std::array<std::int32_t, list_count>;

  [[nodiscard]] Counts counts() const;
  void make_room(const Counts& wanted);
  void share(PatchSearchBatch& batch) const;
  [[nodiscard]] bool have_room(const Counts& counts) const;
  Counts search(PatchSearchBatch batch);
  void search_slice(const PatchSearchBatch& batch, int pairs);

  Backend backend_;
  PlacedArrays arrays_;
  SearchedField field_;
  BlackbodyTable colours_;
  Counts rooms_{};  //!< of the lists
  Buffer<SearchedPair> pairs_[3];
  Buffer<RoughImage> images_;
  Buffer<SeenImage> exact_;
  Buffer<float> parts_[4];
  Buffer<FoldedRoot> plain_roots_;
  Buffer<FoldedRoot> folded_roots_;
  Buffer<FoldedRoot> told_;
  Buffer<std::int32_t> told_counts_;
  Buffer<std::int32_t> told_first_;
  Buffer<std::int32_t> counts_;
};

}  // namespace ergodome
