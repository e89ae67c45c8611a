#pragma once

#include "kernels/disk/disk_chart.h"
#include "kernels/lens/lens_grid.h"

namespace ergodome::inline ERGO_TARGET {

//! Position of one lane in the cells of a disk's grid, with its derivatives along the image's rows
//! and columns.
struct DiskLanePlace {
  float gamma_turns;
  float s;
  float gamma_along_x, gamma_along_y;
  float s_along_x, s_along_y;

  //! Converts derivatives along γ and s to the derivative along the image's rows.
  [[nodiscard]] ERGO_HD float along_x(float along_gamma, float along_s) const {
    return along_gamma * gamma_along_x + along_s * s_along_x;
  }
  //! Converts derivatives along γ and s to the derivative along the image's columns.
  [[nodiscard]] ERGO_HD float along_y(float along_gamma, float along_s) const {
    return along_gamma * gamma_along_y + along_s * s_along_y;
  }
};

//! Returns the position of lane `i`. A grid of half the sky is read at -γ for the other half.
template <class T>
ERGO_HD DiskLanePlace disk_lane_place(const LensGrid& cells, const DiskPlace<T>& place, int i) {
  const float turns = lane(place.gamma_turns.value, i);
  const bool over = cells.mirrored != 0 && turns > 0.5F;
  const float side = over ? -1.0F : 1.0F;
  return {over ? 1.0F - turns : turns,
          lane(place.s.value, i),
          side * lane(place.gamma_turns.along_x, i),
          side * lane(place.gamma_turns.along_y, i),
          lane(place.s.along_x, i),
          lane(place.s.along_y, i)};
}

}  // namespace ergodome::inline ERGO_TARGET
