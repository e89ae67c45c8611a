#pragma once

#include <vector>

#include "content/lens_station.h"
#include "kernels/disk/disk_grid.h"

namespace ergodome {

//! Where the light of one place of a camera crosses the disk's plane: a grid over its whole sky in the rain frame, the shadow included, which
//! serves every motion, orientation and azimuth of the camera there. DiskGrid says what the arrays hold.
struct DiskStation {
  LensStation cells;     //!< without nodes; its chart is that of kernels/disk/disk_chart.h, without a range
  double inner_r = 0.0;  //!< edges of the disk that it is for [M]
  double outer_r = 0.0;
  bool pattern = false;  //!< whether it holds azimuth and time
  std::vector<float> nodes[layer_orders];
  std::vector<unsigned char> orders;

  //! Sets of nodes that it has.
  [[nodiscard]] int sets() const { return pattern ? layer_orders : 1; }
};

}  // namespace ergodome
