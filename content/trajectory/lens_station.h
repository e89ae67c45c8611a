#pragma once

#include <vector>

#include "kernels/lens/lens_grid.h"

namespace ergodome {

//! The lens of one place of a camera: a grid over its whole sky in the rain frame, which serves every motion, orientation and azimuth
//! of the camera there. LensGrid says what the arrays hold.
struct LensStation {
  double spin = 0.0;        //!< [M]
  double r = 0.0;           //!< Boyer-Lindquist radius [M]
  double theta = 0.0;       //!< polar angle [rad]
  Vector3<float> centre{};  //!< axes of the chart, see EdgeCurve
  Vector3<float> first{};
  Vector3<float> second{};
  std::vector<float> edge;  //!< polar angle of the shadow's edge at equal steps of γ [rad]
  float range = 1.0F;
  bool mirrored = false;
  int columns = 0;
  int rows = 0;
  std::vector<int> tree;
  std::vector<int> leaves;
  std::vector<float> nodes;
  std::vector<float> leaf_error_px;  //!< greatest error at a leaf's check points [px]
  //! What grids for images of stars keep, empty where nobody asked for it: the nodes as rays have them, also those in the middle of a larger
  //! leaf's side, and the displacements at each leaf's checks (CheckBatch), those along γ before those along s.
  std::vector<float> traced_nodes;
  std::vector<float> leaf_displacements;
  //! How the nodes change with the camera's place at fixed (γ, s), with what moving turns of itself taken out (see place_turn): along r
  //! [1/M] and θ [1/rad], shaped as `nodes`. Empty where nobody asked for them.
  std::vector<float> nodes_along_r;
  std::vector<float> nodes_along_theta;

  [[nodiscard]] std::size_t node_count() const { return nodes.size() / floats_a_node; }
  [[nodiscard]] std::size_t leaf_count() const { return leaves.size() / 4; }
};

//! The station as kernels on the host read it; it points into the station.
LensGrid grid_view(const LensStation& station);

//! Where a leaf lies in the chart.
struct LeafBox {
  double gamma_turns = 0.0;
  double s = 0.0;
  double width_turns = 0.0;
  double height = 0.0;
};

//! The boxes of all leaves, by number.
std::vector<LeafBox> leaf_boxes(const LensStation& station);

//! Whether a leaf's pixels are to be traced, leaf by leaf.
std::vector<bool> flagged_leaves(const LensStation& station);

}  // namespace ergodome
