#pragma once

#include <vector>

#include "kernels/near_rays/near_ray.h"

// An independent integrator in Boyer-Lindquist coordinates. It is the reference for crossings of
// shells.
namespace ergodome::test {

//! The crossing of a ray with a sphere r = const.
struct WalkedCrossing {
  //! Polar angle [rad]; outside [0, π] if a ray with L = 0 has passed over a pole.
  double theta;
  //! Azimuth relative to the camera [rad], not reduced to a full turn.
  double phi;
  //! Travel time of light in coordinate time [M].
  double delay;
  //! Mino time of the crossing [1/M].
  double time;
};

//! Follows a ray in r, θ, φ and t by many small steps of the classical Runge-Kutta method, and
//! returns its crossings of r = `shell_r`. It uses none of the means of the methods that it checks:
//! no Taylor series, no u = 1/r, no unit vectors. Ends at the horizon, or where r exceeds
//! `farthest_r`.
std::vector<WalkedCrossing> walk_to_shell(double spin, const NearRay<double>& ray, double shell_r, double farthest_r);

}  // namespace ergodome::test
