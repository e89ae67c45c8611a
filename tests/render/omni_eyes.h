#pragma once

#include <cmath>
#include <memory>

#include "content/show/reading/show_reader.h"
#include "render/lens/omni_lens.h"
#include "tests/render/exact_sky.h"

// The geometry of omnidirectional stereo by its definition, as a reference.
namespace ergodome::test {

//! Returns the position of an eye by the definition of omnidirectional stereo: to the right of the
//! viewing direction, fading with the cosine of the elevation between 60 and 90 degrees.
inline Vector3<double> omni_place(const Vector3<double>& view, double offset) {
  const double azimuth = std::atan2(view.x, -view.z);
  const double level = std::hypot(view.x, view.z) / std::cos(pi / 3.0);
  const double part = level < 1.0 ? level * level * (3.0 - 2.0 * level) : 1.0;
  return {offset * part * std::cos(azimuth), 0.0, offset * part * std::sin(azimuth)};
}

//! A ray in one direction of the view, from a camera that is set up at the eye's position for this
//! direction only.
struct OwnRay {
  CameraStation camera;
  Vector3<double> n;  //!< unit vector of the ray, in the frame of `camera`
};

inline OwnRay own_ray(const EyePlace& eye_at, const Vector3<double>& view, double offset, double convergence) {
  const Vector3<double> place = omni_place(view, offset);
  const EyeCamera eye = eye_at(place);
  const Vector3<double> n_view = convergence > 0.0 ? unit_of(view - (1.0 / convergence) * place) : view;
  const auto& m = eye.frame_from_view;
  const auto row = [&](int i) { return m[i][0] * n_view.x + m[i][1] * n_view.y + m[i][2] * n_view.z; };
  return {make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity),
          {row(0), row(1), row(2)}};
}

}  // namespace ergodome::test
