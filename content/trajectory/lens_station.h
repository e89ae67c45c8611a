#pragma once

#include <vector>

#include "kernels/lens/lens_grid.h"
#include "kernels/spacetime/spacetime.h"

namespace ergodome {

//! The lens map of one camera position: a grid over all view directions in the rain frame. It
//! applies to every motion, orientation and azimuth of the camera at that position. LensGrid
//! documents the arrays.
struct LensStation {
  Spacetime spacetime;
  double r = 0.0;           //!< Boyer-Lindquist radius [M]
  double theta = 0.0;       //!< polar angle [rad]
  Vector3<float> centre{};  //!< axes of the chart, see EdgeCurve
  Vector3<float> first{};
  Vector3<float> second{};
  std::vector<float> edge;  //!< angle of the shadow's edge from `centre` at equal steps of γ [rad]
  float range = 1.0F;
  bool mirrored = false;
  int columns = 0;
  int rows = 0;
  std::vector<int> tree;
  std::vector<int> leaves;
  std::vector<float> nodes;
  //! Maximum displacement on the screen at each leaf's check points [px].
  std::vector<float> leaf_error_px;
  //! Data for the search for star images; empty if not requested. `traced_nodes` are the nodes as
  //! traced by rays, including nodes in the middle of a larger leaf's side. `leaf_displacements`
  //! are the displacements at each leaf's check points (CheckBatch), first those along γ, then
  //! those along s.
  std::vector<float> traced_nodes;
  std::vector<float> leaf_displacements;
  //! Derivatives of the nodes with respect to the camera's position at fixed (γ, s), without the
  //! rotation that frame_rotation() describes: along r [1/M] and θ [1/rad], shaped as `nodes`.
  //! Empty if not requested.
  std::vector<float> nodes_along_r;
  std::vector<float> nodes_along_theta;
  //! Coefficients of the second order in the offset of the camera: of Δr² [1/M²] and of Δr Δθ
  //! [1/(M rad)], shaped as `nodes`. Only a grid for a cell of camera positions has them
  //! (add_cell_motion()); the derivatives are then means over the cell. Trajectories do not store
  //! them.
  std::vector<float> nodes_along_r_r;
  std::vector<float> nodes_along_r_theta;

  [[nodiscard]] std::size_t node_count() const { return nodes.size() / floats_a_node; }
  [[nodiscard]] std::size_t leaf_count() const { return leaves.size() / 4; }
};

//! Returns a view of the station for host kernels, which points into the station.
LensGrid grid_view(const LensStation& station);

//! The rectangle of a leaf in the chart.
struct LeafBox {
  double gamma_turns = 0.0;
  double s = 0.0;
  double width_turns = 0.0;
  double height = 0.0;
};

//! Returns the rectangles of all leaves, by leaf index.
std::vector<LeafBox> leaf_boxes(const LensStation& station);

//! Returns for each leaf whether its pixels must be traced.
std::vector<bool> flagged_leaves(const LensStation& station);

}  // namespace ergodome
