#pragma once

#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/disk/disk_grid.h"

namespace ergodome {

//! Disk crossings of the light that reaches one camera position: a grid over all view directions in
//! the rain frame, including those in the shadow. It applies to every motion, orientation and
//! azimuth of the camera at that position. DiskGrid documents the arrays.
struct DiskStation {
  //! Arrays of nodes. If the disk has a pattern, there is one for each order of crossing; otherwise
  //! only the first is used, and its nodes have 1/r of all orders.
  using NodeSets = std::vector<float>[layer_orders];

  //! Grid cells, without nodes; the chart is that of kernels/disk/disk_chart.h, which does not use
  //! LensStation::range.
  LensStation cells;
  double inner_r = 0.0;  //!< inner edge of the disk [M]
  double outer_r = 0.0;
  bool pattern = false;  //!< true if the nodes contain azimuth and time
  NodeSets nodes;
  //! Derivatives of the nodes with respect to the camera's position at fixed (γ, s): along r [1/M]
  //! and θ [1/rad]. Empty if not requested.
  NodeSets nodes_along_r;
  NodeSets nodes_along_theta;
  std::vector<unsigned char> orders;
  std::vector<float> nearness;  //!< DiskGrid::nearness; empty if not requested; never stored in files

  //! Returns the number of sets of nodes.
  [[nodiscard]] int sets() const { return pattern ? layer_orders : 1; }
  [[nodiscard]] std::size_t node_count() const { return nodes[0].size() / floats_a_node; }
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] bool has_derivatives() const { return !nodes_along_r[0].empty(); }
};

//! Returns a view of the grid for host kernels, which points into the station.
DiskGrid disk_grid_view(const DiskStation& station);

}  // namespace ergodome
