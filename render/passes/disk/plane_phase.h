#pragma once

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/edge_curve.h"

namespace ergodome {

//! Initial state of a light ray traced backwards from a camera.
struct StartPhase {
  float phase;  //!< of its swing through the equatorial plane, from 0 (straight towards it) to π (straight away) [rad]
  bool reaches;  //!< it may originate within the disk's outer edge
};

//! Phase of the swing through the equatorial plane with which rays start, as a function of the
//! position in the chart of a disk grid.
//!
//! Near the equatorial plane, m_z = z_0 cos ωλ + (z_0'/ω) sin ωλ, which crosses the plane at ωλ = π
//! - phase. For a camera close to the plane, all phases lie in a narrow band of its sky, where it
//! sees the disk edge-on.
class PlanePhase {
 public:
  PlanePhase(const CameraStation& rain, const EdgeCurve& edge, double outer_r);

  //! Returns the initial state at a position in the chart.
  [[nodiscard]] StartPhase at(float gamma_turns, float s) const;

 private:
  const CameraStation& rain_;
  const EdgeCurve& edge_;
  double outer_r_;
  bool matters_;  //!< the camera is close to the plane, but not in it
};

}  // namespace ergodome
