#pragma once

#include <random>

#include "tests/hard_cases/hard_case.h"

// Directions about what is hard on a camera's sky.
namespace ergodome::test {

//! Evenly over the whole sky, the same for each camera.
Directions whole_sky(const CameraStation& camera);

//! So far outside the shadow's edge, and so far inside, all round it [rad].
Directions beside_edge(const CameraStation& camera, double distance);

template <int Exponent>
Directions beside_edge_1e(const CameraStation& camera) {
  double distance = 1.0;
  for (int i = 0; i < Exponent; ++i) {
    distance *= 0.1;
  }
  return beside_edge(camera, distance);
}

//! Along the two principal null directions, and 1e-12 ... 1e-3 rad beside them.
Directions about_principal_rays(const CameraStation& camera);

//! Light without angular momentum, which passes through the axis, and 1e-12 ... 1e-3 rad beside it.
Directions without_angular_momentum(const CameraStation& camera);

//! Light that comes from a pole of the sky, or from φ = ±π, within what can be told, and from
//! beside it.
Directions towards_sky_poles(const CameraStation& camera);
Directions towards_sky_seam(const CameraStation& camera);

//! Zenith, rim and the edge of the circle of a dome that looks at the hole, tilted by 30 degrees.
Directions dome_zenith_and_rim(const CameraStation& camera);

//! Along the camera's own axes.
Directions along_axes(const CameraStation& camera);

//! Any direction, evenly.
Vector3<double> any_direction(std::mt19937_64& random);

//! A direction so far from n [rad], on any side.
Vector3<double> beside(const Vector3<double>& n, double angle, double side);

}  // namespace ergodome::test
