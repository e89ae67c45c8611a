#pragma once

#include <random>

#include "tests/hard_cases/hard_case.h"

// Directions in a camera's sky: over all of it, and near its hard features.
namespace ergodome::test {

//! Returns directions spread evenly over the whole sky, the same for each camera.
Directions whole_sky(const CameraStation& camera);

//! Returns directions at this distance [rad] outside and inside the shadow's edge, all around it.
Directions beside_edge(const CameraStation& camera, double distance);

template <int Exponent>
Directions beside_edge_1e(const CameraStation& camera) {
  double distance = 1.0;
  for (int i = 0; i < Exponent; ++i) {
    distance *= 0.1;
  }
  return beside_edge(camera, distance);
}

//! Returns the two principal null directions, and directions 1e-12 ... 1e-3 rad from them.
Directions about_principal_rays(const CameraStation& camera);

//! Returns light without angular momentum, which crosses the axis, and light 1e-12 ... 1e-3 rad
//! from it.
Directions without_angular_momentum(const CameraStation& camera);

//! Returns light that comes from a pole of the sky, or from φ = ±π, as exactly as double resolves,
//! and light from nearby.
Directions towards_sky_poles(const CameraStation& camera);
Directions towards_sky_seam(const CameraStation& camera);

//! Returns zenith, rim and edge of the image circle of a dome that faces the hole, tilted by 30
//! degrees.
Directions dome_zenith_and_rim(const CameraStation& camera);

//! Returns the camera's axes.
Directions along_axes(const CameraStation& camera);

//! Returns a random direction, uniform over the sphere.
Vector3<double> any_direction(std::mt19937_64& random);

//! Returns a direction at an angle [rad] from n, on the side given by the position angle `side`
//! [rad].
Vector3<double> beside(const Vector3<double>& n, double angle, double side);

}  // namespace ergodome::test
