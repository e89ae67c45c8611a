#pragma once

#include <bit>

#include "kernels/core/lanes.h"
#include "kernels/core/vector3.h"
#include "kernels/stars/star_bands.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds the stars of cells that lie within planes. Runs once, with stars as lanes.
template <class T>
struct SearchStars {
  using Mask = MaskOf<T>;
  static constexpr int lanes = RealTraits<T>::lane_count;
  static_assert(lanes <= star_padding);

  const StarSearchBatch& batch;

  ERGO_HD void operator()(int /*index*/) const {
    const StarBands& stars = batch.stars;
    const int end_cell = batch.first_cell + batch.cell_count;
    int count = 0;
    for (int band = batch.first_band; band < batch.last_band; ++band) {
      const int* const first = stars.first + band * stars.cells;
      if (end_cell <= stars.cells) {
        count = search(first[batch.first_cell], first[end_cell], count);
      } else {
        count = search(first[batch.first_cell], first[stars.cells], count);
        count = search(first[0], first[end_cell - stars.cells], count);
      }
    }
    *batch.count = count;
  }

 private:
  //! Appends the stars found in [first, last) to the `count` found before. Returns the new count.
  ERGO_HD int search(int first, int last, int count) const {
    const StarBands& stars = batch.stars;
    for (int at = first; at < last; at += lanes) {
      const Vector3<T> direction = {load(stars.direction[0], at), load(stars.direction[1], at),
                                    load(stars.direction[2], at)};
      Mask held = load(stars.illuminance, at) >= T(batch.faintest);
      ERGO_UNROLL
      for (int i = 0; i < 4; ++i) {
        const float(&inward)[3] = batch.inward[i];
        held = held & (inward[0] * direction.x + inward[1] * direction.y + inward[2] * direction.z >= T(0.0F));
      }
      for (unsigned bits = mask_bits(held) & bits_within<T>(at, last); bits != 0; bits &= bits - 1) {
        batch.found[count] = at + std::countr_zero(bits);
        ++count;
      }
    }
    return count;
  }

  //! The arrays are padded for packs that read past their last element.
  ERGO_HD static T load(const float* from, int at) { return load_lanes<T>(from, at, at + lanes); }
};

template <class T, class Action>
void dispatch(const StarSearchBatch& batch, const Action& action) {
  action(SearchStars<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
