#pragma once

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/edge_curve.h"

namespace ergodome {

//! How light starts, seen backwards from a camera.
struct StartPhase {
  float
      phase;  //!< of its swing through the equatorial plane, in [0, π] from going straight at it to going straight away [rad]
  bool reaches;  //!< it may come from within the disk's outer edge
};

//! The phase of the swing through the equatorial plane in which light starts, over the chart of a disk's grid.
//!
//! Near the equatorial plane, m_z = z_0 cos ωλ + (z_0'/ω) sin ωλ: it crosses the plane at ωλ = π - phase. For a camera close to the plane all
//! phases lie side by side in a narrow band of its sky, which is where it sees the disk from its edge.
class PlanePhase {
 public:
  PlanePhase(const CameraStation& rain, const EdgeCurve& edge, double outer_r);

  //! At a place of the chart.
  [[nodiscard]] StartPhase at(float gamma_turns, float s) const;

 private:
  const CameraStation& rain_;
  const EdgeCurve& edge_;
  double outer_r_;
  bool matters_;  //!< the camera is close to the plane, and not in it
};

}  // namespace ergodome
