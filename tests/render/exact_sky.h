#pragma once

#include <cmath>

#include "kernels/spacetime/geodesic/closed_form.h"
#include "tests/render/passes/stars/star_cameras.h"

// The sky by the closed form, as a reference for star images and lenses.
namespace ergodome::test {

//! Returns the sky direction that a camera sees in the direction n, by the closed form.
inline Vector3<double> exact_sky(const CameraStation& camera, const Vector3<double>& n) {
  return turned_to_camera(camera, trace_closed_form(camera.spin, start_ray(camera, unit_of(n))).sky);
}

//! The error of a star image's position, and its exact magnification, both by the closed form.
struct ImageError {
  double miss;  //!< angle between the image and its exact position [rad]
  double magnification;
};

inline ImageError error_of(const CameraStation& camera, const Vector3<double>& n, const Vector3<double>& star) {
  const Vector3<double> e1 =
      unit_of(cross(std::abs(n.z) < 0.9 ? Vector3<double>{0, 0, 1} : Vector3<double>{1, 0, 0}, n));
  const Vector3<double> e2 = cross(n, e1);
  const double h = 1e-6;
  const auto derivative = [&](const Vector3<double>& e) {
    return (0.5 / h) * (exact_sky(camera, n + h * e) - exact_sky(camera, n - h * e));
  };
  const Vector3<double> j1 = derivative(e1);
  const Vector3<double> j2 = derivative(e2);
  const Vector3<double> missing = star - exact_sky(camera, n);
  const double a = dot(j1, j1);
  const double b = dot(j1, j2);
  const double c = dot(j2, j2);
  const double determinant = a * c - b * b;
  const double x = (c * dot(j1, missing) - b * dot(j2, missing)) / determinant;
  const double y = (a * dot(j2, missing) - b * dot(j1, missing)) / determinant;
  return {std::hypot(x, y), 1.0 / std::sqrt(determinant)};
}

}  // namespace ergodome::test
