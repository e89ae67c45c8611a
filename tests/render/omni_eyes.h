#pragma once

#include <cmath>
#include <memory>

#include "content/show/reading/show_reader.h"
#include "render/lens/omni_lens.h"
#include "tests/render/exact_sky.h"

// The geometry of omnidirectional stereo directly from its definition, as a reference for tests.
namespace ergodome::test {

//! Returns the position of an eye by the definition of omnidirectional stereo. The eye is to the
//! right of the view direction by `offset`. This distance decreases to 0 between elevations of 60
//! and 90 degrees.
inline Vector3<double> omni_position(const Vector3<double>& view, double offset) {
  const double azimuth = std::atan2(view.x, -view.z);
  const double level = std::hypot(view.x, view.z) / std::cos(pi / 3.0);
  const double part = level < 1.0 ? level * level * (3.0 - 2.0 * level) : 1.0;
  return {offset * part * std::cos(azimuth), 0.0, offset * part * std::sin(azimuth)};
}

//! A ray in one direction of the view, from a camera that exists only for this direction, at the
//! position that omnidirectional stereo defines for it.
struct DirectRay {
  CameraStation camera;
  //! Direction of the ray, in the frame of `camera`; a unit vector.
  Vector3<double> n;
};

inline DirectRay direct_ray(const EyeAtOffset& eye_at, const Vector3<double>& view, double offset, double convergence) {
  const Vector3<double> position = omni_position(view, offset);
  const EyeCamera eye = eye_at(position);
  const Vector3<double> n_view = convergence > 0.0 ? unit_of(view - (1.0 / convergence) * position) : view;
  const auto& m = eye.frame_from_view;
  const auto row = [&](int i) { return m[i][0] * n_view.x + m[i][1] * n_view.y + m[i][2] * n_view.z; };
  return {make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity),
          {row(0), row(1), row(2)}};
}

}  // namespace ergodome::test
