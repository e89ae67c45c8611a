#pragma once

#include <bit>

#include "kernels/core/lanes.h"
#include "kernels/core/vector3.h"
#include "kernels/stars/star_index.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds the stars within planes, from coarse cells to fine ones; there is one index, whose lanes are cells, and stars.
template <class T>
struct SearchStars {
  using Mask = MaskOf<T>;
  static constexpr int lanes = RealTraits<T>::lane_count;
  static_assert(lanes <= star_index_padding);

  const StarSearchBatch& batch;

  ERGO_HD void operator()(int /*index*/) const {
    *batch.count = 0;
    search_cells(0, 0, coarsest_star_cells);
  }

 private:
  ERGO_HD void search_cells(int level, int first, int last) const {
    const StarIndexLevel& cells = batch.index.level[level];
    const bool finest = level + 1 == batch.index.level_count;
    for (int at = first; at < last; at += lanes) {
      const Mask touched =
          (load(cells.brightest, at) >= T(batch.faintest)) & inside(load(cells.axis, at), -load(cells.sine, at));
      for (unsigned bits = mask_bits(touched) & bits_within<T>(at, last); bits != 0; bits &= bits - 1) {
        const int cell = at + std::countr_zero(bits);
        if (finest) {
          search_stars(batch.index.first[cell], batch.index.first[cell + 1]);
        } else {
          search_cells(level + 1, star_cell_children * cell, star_cell_children * (cell + 1));
        }
      }
    }
  }

  ERGO_HD void search_stars(int first, int last) const {
    const StarIndex& index = batch.index;
    int count = *batch.count;
    for (int at = first; at < last && index.illuminance[at] >= batch.faintest; at += lanes) {
      const Mask held = (load(index.illuminance, at) >= T(batch.faintest)) & inside(load(index.direction, at), T(0.0F));
      for (unsigned bits = mask_bits(held) & bits_within<T>(at, last); bits != 0; bits &= bits - 1) {
        batch.found[count] = at + std::countr_zero(bits);
        ++count;
      }
    }
    *batch.count = count;
  }

  //! Arrays have room behind their last element for what lanes read there.
  ERGO_HD static T load(const float* from, int at) { return load_lanes<T>(from, at, at + lanes); }

  ERGO_HD static Vector3<T> load(const float* const (&from)[3], int at) {
    return {load(from[0], at), load(from[1], at), load(from[2], at)};
  }

  //! Lanes at least so high above all planes.
  ERGO_HD Mask inside(const Vector3<T>& direction, const T& least) const {
    Mask in = T(0.0F) < T(1.0F);
    ERGO_UNROLL
    for (int i = 0; i < 5; ++i) {
      const float(&inward)[3] = batch.inward[i];
      in = in & (inward[0] * direction.x + inward[1] * direction.y + inward[2] * direction.z >= least);
    }
    return in;
  }
};

}  // namespace ergodome::inline ERGO_TARGET
