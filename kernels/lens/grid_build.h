#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/launch/kernel.h"
#include "kernels/lens/lens_grid.h"
#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"

// Batches that trace the nodes of a lens grid and check its cells.
namespace ergodome {

//! Inputs shared by the kernels that trace a grid's rays: camera, chart and integration settings.
//! The camera is in the rain frame at φ = 0, or, for an omnidirectional eye (OmniCameraOf), in the
//! view's axes.
template <class S, class Camera = CameraStationOf<S>>
struct GridCamera {
  Camera rays;
  LensChart chart;
  IntegrationSettings settings;
};

//! Nodes of a grid to trace. The first padding float of a node is 1 if its ray came from the sky
//! and converged, otherwise 0.
template <class S, class Camera = CameraStationOf<S>>
struct NodeBatch {
  GridCamera<S, Camera> camera;
  int count;
  const float* gamma_turns;
  const float* s;
  float* nodes;  //!< out: floats_a_node floats for each node
};

//! A cell to check: its four nodes, position and extent.
struct GridCell {
  int corners[4];
  float gamma_turns;
  float s;
  float width_turns;
  float height;
};

//! Points at which a cell is checked: two inside, and the midpoints of its sides at s0, s1, γ0, γ1.
//! At the center, the error of a cubic can be 0 by symmetry although it is large elsewhere.
inline constexpr int checks_a_cell = 6;

//! Distance of the inner points from the corners, as a fraction of the cell's diagonal.
inline constexpr float inner_check = 0.3F;

//! Cells to check by traced rays: kernel index i is check i % checks_a_cell of cell i /
//! checks_a_cell.
template <class S, class Camera = CameraStationOf<S>>
struct CheckBatch {
  GridCamera<S, Camera> camera;
  AberrationOf<S> observer;  //!< observer for whose screen errors are measured
  S pixel;                   //!< angle that a pixel of that screen subtends [rad]
  int count;                 //!< number of checks: checks_a_cell per cell
  const GridCell* cells;
  const float* nodes;
  //! Error of the cell's patch: displacement on the screen against the traced ray [px], less the
  //! noise of the tracing. 1e30 if the ray of the check or of one of the corners does not come from
  //! the sky, or did not converge.
  float* error_px;
  float* area_px;  //!< area of the cell on the screen, computed with the scale at the check [px²]
  // The error as a displacement of the camera direction in the chart, along γ and along s, in
  // fractions of the cell's sides. Includes the error of the tracing itself. 1e30 if unknown.
  float* gamma_parts;
  float* s_parts;
};

template <class S, class Camera>
struct Kernel<NodeBatch<S, Camera>> : KernelDefaults {
  using Real = S;
  static constexpr int grain = grid_grain;
  static const char* name(const NodeBatch<S, Camera>& /*batch*/) {
    return std::is_same_v<S, double> ? "trace_nodes, double" : "trace_nodes";
  }
  static int elements(const NodeBatch<S, Camera>& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const NodeBatch<S, Camera>& batch, const Visit& visit) {
    visit("nodes", batch.nodes, static_cast<long>(batch.count) * floats_a_node);
  }
};

template <class S, class Camera>
struct Kernel<CheckBatch<S, Camera>> : KernelDefaults {
  using Real = S;
  static constexpr int grain = grid_grain;
  static const char* name(const CheckBatch<S, Camera>& /*batch*/) {
    return std::is_same_v<S, double> ? "check_cells, double" : "check_cells";
  }
  static int elements(const CheckBatch<S, Camera>& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const CheckBatch<S, Camera>& batch, const Visit& visit) {
    visit("error_px", batch.error_px, batch.count);
    visit("area_px", batch.area_px, batch.count);
    visit("gamma_parts", batch.gamma_parts, batch.count);
    visit("s_parts", batch.s_parts, batch.count);
  }
};

}  // namespace ergodome
