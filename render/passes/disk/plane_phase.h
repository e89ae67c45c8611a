#pragma once

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/edge_curve.h"

namespace ergodome {

//! Initial state of a light ray traced backwards from a camera.
struct StartPhase {
  //! Phase of the ray's oscillation through the equatorial plane [rad], from 0 (in the plane and
  //! moving away from it) to π (arriving at it).
  float phase;
  bool reaches;  //!< true if the ray may reach radii within the disk's outer edge
};

//! Phase with which rays start their oscillation through the equatorial plane, as a function of the
//! position in the chart of a disk grid.
//!
//! Near the equatorial plane, m_z = z_0 cos ωλ + (z_0'/ω) sin ωλ, which crosses the plane at ωλ = π
//! - phase; here λ is Mino time, and z_0 and z_0' are m_z and its derivative by λ at the camera.
//! For a camera close to the plane, all phases lie in a narrow band of its sky, where it sees the
//! disk edge-on.
class PlanePhase {
 public:
  PlanePhase(const CameraStation& rain, const EdgeCurve& edge, double outer_r);

  //! Returns the initial state at a position in the chart; {0, false} if phases are not needed.
  [[nodiscard]] StartPhase at(float gamma_turns, float s) const;

 private:
  const CameraStation& rain_;
  const EdgeCurve& edge_;
  double outer_r_;
  //! True if the camera is so close to the plane that phases are needed, but not in it.
  bool matters_;
};

}  // namespace ergodome
