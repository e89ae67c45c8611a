#pragma once

#include <cstddef>
#include <vector>

#include "kernels/stars/patch_search.h"
#include "render/backend/buffer.h"
#include "render/stars/star_patches.h"
#include "render/stars/view_cone.h"

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
  PlacedPatches(Backend backend, const StarPatches& patches) : arrays_(backend) { set(patches); }

  //! Others, in the place of those.
  void set(const StarPatches& patches);

  //! Without what a search is for.
  [[nodiscard]] const PatchSearchBatch& batch() const { return batch_; }

 private:
  PlacedArrays arrays_;
  PatchSearchBatch batch_{};
};

//! Finds images of stars roughly, on a device: what RoughImageFinder finds, in an order that chance decides.
class PatchSearch {
 public:
  //! `room`: for pairs and images at first.
  PatchSearch(Backend backend, const StarField& field, int room = 1 << 16);

  [[nodiscard]] Backend backend() const { return backend_; }

  //! The camera is at `phi` [rad]; patches are of this field.
  std::vector<RoughImage> find(const PlacedPatches& patches, double phi, const ViewCone& view);

 private:
  //! Where lists lie, and how long they are.
  struct Lists {
    Buffer<SearchedPair> pairs[3];
    Buffer<RoughImage> images;
    Buffer<std::int32_t> counts;  //!< of the pairs, and of the images
  };
  static constexpr int list_count = 4;

  void share(PatchSearchBatch& batch) const;
  [[nodiscard]] std::vector<std::int32_t> counts() const;
  bool grow(const std::vector<std::int32_t>& counts);
  bool search(const PatchSearchBatch& batch, std::vector<RoughImage>& images);

  Backend backend_;
  PlacedArrays arrays_;
  SearchedField field_;
  Lists lists_;
};

}  // namespace ergodome
