#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/vector3.h"
#include "kernels/stars/star_index.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds the stars within planes, from coarse cells to fine ones; there is one index, whose lanes are cells, and stars.
template <class T>
struct SearchStars {
  using Mask = MaskOf<T>;
  static constexpr int lanes = RealTraits<T>::lane_count;

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
      if (!any(touched)) {
        continue;
      }
      for (int i = 0; i < lanes && at + i < last; ++i) {
        if (!mask_lane(touched, i)) {
          continue;
        }
        if (finest) {
          search_stars(batch.index.first[at + i], batch.index.first[at + i + 1]);
        } else {
          search_cells(level + 1, star_cell_children * (at + i), star_cell_children * (at + i + 1));
        }
      }
    }
  }

  ERGO_HD void search_stars(int first, int last) const {
    const StarIndex& index = batch.index;
    int count = *batch.count;
    for (int at = first; at < last && index.illuminance[at] >= batch.faintest; at += lanes) {
      const Mask held = (load(index.illuminance, at) >= T(batch.faintest)) & inside(load(index.direction, at), T(0.0F));
      if (!any(held)) {
        continue;
      }
      // Without branches, which would not be foretold.
      for (int i = 0; i < lanes && at + i < last; ++i) {
        batch.found[count] = at + i;
        count += mask_lane(held, i) ? 1 : 0;
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
