#include "render/stereo/eye_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/lens/flat/flat_shadow.h"
#include "render/lens/omni_lens.h"

namespace ergodome {

namespace {

//! Maximum baseline as a fraction of r. Far from the hole, polynomials of degree 10 are accurate
//! enough for eyes up to 2 × 0.39 r apart.
constexpr double share_of_r = 0.72;

//! Returns omni_room() of a head if none of its eyes is near the horizon, where light is described
//! in the azimuth of infalling observers.
double room_outside(Spacetime spacetime, double r, double outwards) {
  return std::min((r - horizon_radius(spacetime)) / outwards, share_of_r * r / std::max(outwards, 1.0));
}

//! Returns the change of r along a proper length of 1 M in the outward direction, in the rain frame
//! if `in_rain`, otherwise in the ZAMO frame; see eye_event().
double outwards_scale(Spacetime spacetime, double r, double theta, bool in_rain) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  return in_rain ? std::sqrt(f.area) / f.sigma : std::sqrt(std::max(f.delta, 0.0) / f.sigma);
}

//! Returns whether the cameras of both eyes can be fitted for a baseline [M].
bool omni_eyes_fit(const Show& show, const CameraPose& pose, double baseline) {
  const EyeAtOffset eye_at = [&](const Vector3<double>& offset) { return eye_camera(show, pose, offset); };
  return make_omni_pair(Backend::cpu, eye_at, omni_settings(show.stereo, baseline, omni_min_exact)).has_value();
}

//! Returns the largest baseline up to `maximum` for which the cameras can be fitted, accurate to a
//! thousandth of `maximum`.
double max_omni_baseline(const Show& show, const CameraPose& pose, double maximum) {
  if (omni_eyes_fit(show, pose, maximum)) {
    return maximum;
  }
  double fits = 0.0;
  double too_far = maximum;
  for (int round = 0; round < 10; ++round) {
    const double middle = 0.5 * (fits + too_far);
    (omni_eyes_fit(show, pose, middle) ? fits : too_far) = middle;
  }
  return fits;
}

//! Returns the largest baseline up to `maximum` that is possible with the show's stereo model.
double max_baseline_up_to(const Show& show, const CameraPose& pose, double maximum) {
  switch (show.stereo.model) {
    case StereoModel::flat:
      return std::min(maximum, FlatShadow(eye_camera(show, pose, 0.0)).max_baseline());
    case StereoModel::omni:
      static_cast<void>(eye_camera(show, pose, 0.0));  // throws errors that do not concern the eyes
      return max_omni_baseline(show, pose, std::min(maximum, omni_room(spacetime_of(show), pose)));
    case StereoModel::physical:
      break;
  }
  return maximum;
}

}  // namespace

double omni_room(Spacetime spacetime, const CameraPose& pose) {
  const bool in_rain = pose.velocity && pose.velocity_in_rain;
  const double outwards = outwards_scale(spacetime, pose.r, pose.theta, in_rain);
  if (!in_rain || !is_near_horizon(spacetime, pose.r)) {
    return room_outside(spacetime, pose.r, outwards);
  }
  const double above = near_horizon_radius(spacetime);
  const double room_above = room_outside(spacetime, above, outwards_scale(spacetime, above, pose.theta, true));
  const double depth = pose.r - std::min(min_interior_radius(spacetime), horizon_radius(spacetime));
  return std::min({room_above, depth / outwards, share_of_r * pose.r / std::max(outwards, 1.0)});
}

double max_baseline(const Show& show, const CameraPose& pose) {
  return max_baseline_up_to(show, pose, std::numeric_limits<double>::infinity());
}

double fitting_baseline(const Show& show, const CameraPose& pose) {
  const double asked = show.stereo.baseline;
  return asked > 0.0 ? max_baseline_up_to(show, pose, asked) : asked;
}

}  // namespace ergodome
