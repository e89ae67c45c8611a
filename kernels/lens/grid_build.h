#pragma once

#include <cstdint>

#include "kernels/lens/lens_grid.h"
#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"

namespace ergodome {

//! What the kernels that trace a grid's rays share: the camera in the rain frame at φ = 0, or the cameras of an eye that turns with the
//! direction (OmniCameraOf) in the view's axes, and the chart.
template <class S, class Camera = CameraStationOf<S>>
struct GridCamera {
  Camera rays;
  LensChart chart;
  IntegrationSettings settings;
};

//! Nodes of a grid to trace. A node's first pad is 1 when its ray came from the sky and converged, else 0.
template <class S, class Camera = CameraStationOf<S>>
struct NodeBatch {
  GridCamera<S, Camera> camera;
  int count;
  const float* gamma_turns;
  const float* s;
  float* nodes;  //!< floats_a_node each
};

//! A cell that is to be checked: its four nodes, its place and extent.
struct GridCell {
  int corners[4];
  float gamma_turns;
  float s;
  float width_turns;
  float height;
};

//! Points at which a cell is checked: two inside, and the middles of its sides at s0, s1, γ0, γ1. In the very middle the error of a
//! cubic can be 0 by its symmetry, however large it is beside.
inline constexpr int checks_a_cell = 6;

//! Where the inner points lie along the cell's diagonal: so far from its corners.
inline constexpr float inner_check = 0.3F;

//! Cells to check by traced rays: kernel index i stands for check i % checks_a_cell of cell i / checks_a_cell.
template <class S, class Camera = CameraStationOf<S>>
struct CheckBatch {
  GridCamera<S, Camera> camera;
  AberrationOf<S> observer;  //!< whose screen counts
  S pixel;                   //!< angle of a pixel on that screen [rad]
  int count;                 //!< checks: checks_a_cell a cell
  const GridCell* cells;
  const float* nodes;
  float* error_px;  //!< displacement on the screen that a viewer sees; huge where a corner or the check has no sky
  float* area_px;   //!< the cell's area on the screen, by the stretch at the check [px²]
  // Where the sky lies that the patch reads there, from there: the same displacement in the chart, as parts of the cell's sides, with what the
  // tracing itself may be wrong. Huge where it is not known.
  float* gamma_parts;
  float* s_parts;
};

}  // namespace ergodome
