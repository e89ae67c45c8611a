#pragma once

#include <vector>

#include "kernels/near_rays/near_ray.h"

// An independent integrator in Boyer-Lindquist coordinates, as a reference for crossings of shells.
namespace ergodome::test {

//! The crossing of a ray with a sphere r = const.
struct WalkedCrossing {
  double theta;  //!< [rad]; outside [0, π] if a ray with L = 0 has passed over a pole
  double phi;    //!< [rad], unwrapped, relative to the camera's
  double delay;  //!< [M]
  double time;   //!< Mino time [1/M]
};

//! Follows a ray by many small steps of the classical Runge-Kutta method in r, θ, φ and t, and
//! finds its crossings of r = `shell_r`. It uses no series, no u and no vectors, in order to check
//! methods that use them. Ends at the horizon, or beyond r = `farthest_r`.
std::vector<WalkedCrossing> walk_to_shell(double spin, const NearRay<double>& ray, double shell_r, double farthest_r);

}  // namespace ergodome::test
