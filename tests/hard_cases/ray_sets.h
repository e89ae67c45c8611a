#pragma once

#include <random>

#include "tests/hard_cases/hard_case.h"

// Sets of directions in a camera's sky: all over the sky, and where tracing is numerically
// difficult.
namespace ergodome::test {

//! Returns directions spread evenly over the whole sky, the same for each camera.
Directions whole_sky(const CameraStation& camera);

//! Returns directions at the given distance [rad] from the edge of the shadow, on both sides, all
//! around it.
Directions beside_edge(const CameraStation& camera, double distance);

template <int Exponent>
Directions beside_edge_1e(const CameraStation& camera) {
  double distance = 1.0;
  for (int i = 0; i < Exponent; ++i) {
    distance *= 0.1;
  }
  return beside_edge(camera, distance);
}

//! Returns the two principal null directions, and directions within 1e-12 ... 1e-3 rad of them.
Directions about_principal_rays(const CameraStation& camera);

//! Returns directions of light without angular momentum, which crosses the spin axis, and
//! directions within 1e-12 ... 1e-3 rad of them.
Directions without_angular_momentum(const CameraStation& camera);

//! towards_sky_poles() returns directions of light that comes from a pole of the sky,
//! towards_sky_seam() from the meridian φ = ±π, as exactly as double resolves, and directions near
//! them.
Directions towards_sky_poles(const CameraStation& camera);
Directions towards_sky_seam(const CameraStation& camera);

//! Returns directions of a dome picture that faces the hole and is tilted by 30 degrees: the
//! zenith, the rim, and the edge of the image circle.
Directions dome_zenith_and_rim(const CameraStation& camera);

//! Returns the directions of the camera's axes.
Directions along_axes(const CameraStation& camera);

//! Returns a random direction, uniform over the sphere.
Vector3<double> any_direction(std::mt19937_64& random);

//! Returns the direction at the given angle [rad] from n. The position angle `side` [rad] selects
//! which of them.
Vector3<double> beside(const Vector3<double>& n, double angle, double side);

}  // namespace ergodome::test
