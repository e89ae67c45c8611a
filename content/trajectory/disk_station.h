#pragma once

#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/disk/disk_grid.h"

namespace ergodome {

//! Where the light of one place of a camera crosses the disk's plane: a grid over its whole sky in the rain frame, the shadow included, which
//! serves every motion, orientation and azimuth of the camera there. DiskGrid says what the arrays hold.
struct DiskStation {
  //! Sets of nodes, one for each order with a pattern, else the first alone.
  using NodeSets = std::vector<float>[layer_orders];

  LensStation cells;     //!< without nodes; its chart is that of kernels/disk/disk_chart.h, without a range
  double inner_r = 0.0;  //!< edges of the disk that it is for [M]
  double outer_r = 0.0;
  bool pattern = false;  //!< whether it holds azimuth and time
  NodeSets nodes;
  //! How the nodes change with the camera's place at fixed (γ, s), along r [1/M] and θ [1/rad]. Empty where nobody asked for them.
  NodeSets nodes_along_r;
  NodeSets nodes_along_theta;
  std::vector<unsigned char> orders;
  std::vector<float> nearness;  //!< DiskGrid::nearness; empty where nobody asked for it, and in files

  //! Sets of nodes that it has.
  [[nodiscard]] int sets() const { return pattern ? layer_orders : 1; }
  [[nodiscard]] std::size_t node_count() const { return nodes[0].size() / floats_a_node; }
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] bool has_derivatives() const { return !nodes_along_r[0].empty(); }
};

//! The grid as kernels on the host read it; it points into the station.
DiskGrid disk_grid_view(const DiskStation& station);

}  // namespace ergodome
