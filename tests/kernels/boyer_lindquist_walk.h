#pragma once

#include <vector>

#include "kernels/near_rays/near_ray.h"

namespace ergodome::test {

//! Where a ray crosses r = const.
struct WalkedCrossing {
  double theta;  //!< [rad]; light that has gone over a pole of an L = 0 ray has one outside [0, π]
  double phi;    //!< [rad], unwrapped, from the camera's
  double delay;  //!< [M]
  double time;   //!< Mino time [1/M]
};

//! Follows a ray by many small steps of the classical Runge-Kutta method in r, θ, φ and t, and
//! finds where it crosses r = `shell_r`: no series, no u, no vectors, to check those who use them.
//! It ends at the horizon, or where r is beyond `farthest_r`.
std::vector<WalkedCrossing> walk_to_shell(double spin, const NearRay<double>& ray, double shell_r, double farthest_r);

}  // namespace ergodome::test
