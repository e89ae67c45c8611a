#pragma once

#include "kernels/objects/aim_ray.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "kernels/spacetime/shadow/critical_curve.h"

// Finds the ray from a point to another point that is at least as far from the hole, either on the
// second way round the hole, or on the first way where that passes close to the hole.
//
// Next to the shadow's edge a ray's end moves about a hundred times as fast as its direction, and
// the edge depends on the spin. In terms of the position angle γ and the logarithm x of the
// distance from the edge, direction and end change at similar rates, which are nearly the same for
// any spin. So Newton's method converges in few steps from the ray without spin.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! A direction of a camera relative to the shadow: position angle γ, and x in place of the angle α
//! from the shadow's center: α = α_e + (π - α_e) / (1 + e^-x), where α_e(γ) is α at the edge [rad].
struct EdgePosition {
  double gamma;
  double x;
};

//! Returns the position in the chart of a direction, for a hole without spin, in closed form. The
//! chart is centered on the hole, and the edge has sinα = √27 u √(1 - 2u),
//! cosα = (1 - 3u) √(1 + 6u), u = 1/r.
ERGO_HD EdgePosition position_without_spin(double u, const Vector3<double>& direction) {
  constexpr double minimum = 1e-15;  // for rays that rounding puts into the shadow
  const double aside = ::sqrt(direction.y * direction.y + direction.z * direction.z);
  const double alpha = ::atan2(aside, -direction.x);
  const double edge = ::atan2(::sqrt(27.0 * (1.0 - 2.0 * u)) * u, (1.0 - 3.0 * u) * ::sqrt(1.0 + 6.0 * u));
  return {::atan2(direction.y, direction.z), ::log(::fmax(alpha - edge, minimum) / ::fmax(pi - alpha, minimum))};
}

//! Returns the direction at the angle `alpha` from a chart's center and at the position angle
//! `gamma`, with the derivatives that these angles carry.
ERGO_HD Vector3<Dual<double>> dual_direction(const ShadowChart& chart, const Dual<double>& alpha,
                                             const Dual<double>& gamma) {
  Dual<double> sine;
  Dual<double> cosine;
  Dual<double> along;
  Dual<double> aside;
  sine_cosine(alpha, sine, cosine);
  sine_cosine(gamma, aside, along);
  along = sine * along;
  aside = sine * aside;
  const auto part_of = [&](double centre, double first, double second) {
    return centre * cosine + first * along + second * aside;
  };
  return {part_of(chart.centre.x, chart.first.x, chart.second.x),
          part_of(chart.centre.y, chart.first.y, chart.second.y),
          part_of(chart.centre.z, chart.first.z, chart.second.z)};
}

//! Returns the direction of a position, with its derivatives by γ and x.
ERGO_HD Vector3<Dual<double>> direction_at(const CameraStation& camera, const ShadowChart& chart,
                                           const EdgePosition& at) {
  const double edge = edge_along_circle(camera, chart, at.gamma, pi);
  // darkness() is 0 all along the edge, so its derivatives give the slope dα_e/dγ.
  const RayStart<Dual<double>> on_edge =
      start_ray(camera, dual_direction(chart, Dual<double>(edge, 1.0, 0.0), Dual<double>(at.gamma, 0.0, 1.0)));
  const Dual<double> dark = darkness(camera.spin, camera.horizon_r, on_edge);
  const double slope = -dark.along_y / dark.along_x;
  const double part = 1.0 / (1.0 + ::exp(-at.x));
  const double rest = 1.0 / (1.0 + ::exp(at.x));
  const Dual<double> alpha(edge + part * (pi - edge), rest * slope, part * rest * (pi - edge));
  return dual_direction(chart, alpha, Dual<double>(at.gamma, 1.0, 0.0));
}

//! Adjusts a direction outside the shadow by Newton's method until its ray meets the target.
//! Returns false if it does not, or if it meets the target on a way round the hole of another
//! order: images of the first way are upright, those of the second are mirrored.
ERGO_HD bool aim_round(const CameraStation& camera, const RayTarget& target, int order, EdgePosition& at,
                       Vector3<double>& direction, Miss& miss) {
  constexpr double longest_turn = 0.5;
  constexpr double longest_step = 1.0;
  const ShadowChart chart = make_shadow_chart(camera);
  for (int round = 0; round < max_aim_rounds; ++round) {
    const Vector3<Dual<double>> n = direction_at(camera, chart, at);
    if (!miss_of(camera, target, n, miss)) {
      return false;
    }
    const double part = ::fmin(1.0, ::fmin(longest_turn / ::fabs(miss.step[0]), longest_step / ::fabs(miss.step[1])));
    at.gamma += part * miss.step[0];
    at.x += part * miss.step[1];
    if (miss.same_side && miss.size < target.near_enough) {
      const Vector3<Dual<double>> last = {n.x + part * (miss.step[0] * n.x.along_x + miss.step[1] * n.x.along_y),
                                          n.y + part * (miss.step[0] * n.y.along_x + miss.step[1] * n.y.along_y),
                                          n.z + part * (miss.step[0] * n.z.along_x + miss.step[1] * n.z.along_y)};
      direction = normalized(plain_vector(last));
      return miss.mirrored == (order == 2);
    }
  }
  return false;
}

ERGO_HD Vector3<double> turned_about_axis(const Vector3<double>& v, double angle) {
  const double cosine = ::cos(angle);
  const double sine = ::sin(angle);
  return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z};
}

//! Estimates the angle by which a hole of spin 1 drags light round on its way, and with it the
//! points where light focuses [rad]. The angle grows from `behind`, for a target directly behind
//! the hole, where both ways round meet, to `all_round`, where the second way has gone all round
//! the hole. The two values are those that find most rays in fewest steps.
ERGO_HD double carried_round(const RayEnds& ends) {
  constexpr double behind = 0.2;
  constexpr double all_round = 1.3;
  const double cosine =
      dot(ends.from, ends.position) / ::sqrt(dot(ends.from, ends.from) * dot(ends.position, ends.position));
  const double from_behind = pi - ::acos(::fmax(-1.0, ::fmin(1.0, cosine)));
  return behind + (all_round - behind) * from_behind / pi;
}

//! Finds the ray by raising the spin from 0 to the frame's in steps; the first step tries the whole
//! spin at once. While a part of the spin is missing, the target is rotated about the spin axis by
//! the angle that this part would drag light, towards +φ for a positive spin. So the target stays
//! on its side of the points where light focuses.
ERGO_HD bool raise_spin(const LocalFrame& frame, const RayEnds& ends, int order, EdgePosition& at,
                        Vector3<double>& direction, Miss& miss) {
  constexpr double smallest_part = 1.0 / 16.0;
  const double spin = frame.camera.spin;
  const double carried = spin * carried_round(ends);
  const ApparentPosition still = apparent_position(ends.from, turned_about_axis(ends.position, carried), order);
  at = position_without_spin(frame.camera.u, in_axes(frame, still.direction));
  EdgePosition rate = {0.0, 0.0};
  double raised = 0.0;
  double part = 1.0;
  while (raised < 1.0) {
    const double next = ::fmin(raised + part, 1.0);
    EdgePosition aimed = {at.gamma + (next - raised) * rate.gamma, at.x + (next - raised) * rate.x};
    const EdgePosition expected = aimed;
    const CameraStation camera = next < 1.0 ? local_frame(Spacetime{next * spin}, ends.from).camera : frame.camera;
    const RayTarget target =
        ray_target(ends.from, turned_about_axis(ends.position, (1.0 - next) * carried), ends.near_enough);
    // A result far from the expected one is another image.
    if (aim_round(camera, target, order, aimed, direction, miss) && ::fabs(aimed.gamma - expected.gamma) < 1.0 &&
        ::fabs(aimed.x - expected.x) < 2.0) {
      const double by = 1.0 / (next - raised);
      rate = {by * (aimed.gamma - at.gamma), by * (aimed.x - at.x)};
      at = aimed;
      raised = next;
      part *= 2.0;
      continue;
    }
    part *= 0.5;
    if (part < smallest_part) {
      return false;
    }
  }
  return true;
}

//! Finds the ray from the direction without spin and the correction that was found for a nearby
//! target. If the correction is 0 or fails, raises the spin in steps. `correction` is what the spin
//! adds to γ and x: on input for a nearby target, on output for this one. Returns false if no ray
//! is found: next to caustics, where it may have merged with another.
ERGO_HD bool aim_round_with_spin(const LocalFrame& frame, const RayEnds& ends, int order, Vector3<double>& direction,
                                 RayCorrection& correction, Miss& miss) {
  const EdgePosition start = position_without_spin(frame.camera.u, direction);
  EdgePosition at = {start.gamma + correction.gamma, start.x + correction.x};
  const bool known = frame.camera.spin == 0.0 || correction.gamma != 0.0 || correction.x != 0.0;
  const RayTarget target = ray_target(ends.from, ends.position, ends.near_enough);
  bool found = known && aim_round(frame.camera, target, order, at, direction, miss);
  if (!found && frame.camera.spin != 0.0) {
    found = raise_spin(frame, ends, order, at, direction, miss);
  }
  correction.gamma = found ? at.gamma - start.gamma : 0.0;
  correction.x = found ? at.x - start.x : 0.0;
  return found;
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
