#pragma once

#include "kernels/objects/aim_ray_round.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"

// Finds the light from a lamp to a point, about a hole of any spin.
namespace ergodome {

//! How light arrives at a point.
struct LightRay {
  //! Unit vector towards the light's origin, in the frame of the zero-angular-momentum observer
  //! (e_r, e_θ, e_φ).
  Vector3<double> direction;
  double travel_time;  //!< coordinate time from the lamp to the point [M]
  //! Spread of a narrow bundle of rays that converge at one end of the ray [M²]. It is the
  //! cross-section of the bundle at the other end, divided by the bundle's solid angle at the end
  //! where it converges, and by the square of the energy that an observer there measures of a
  //! photon with energy 1 at infinity. The spread is the same if the ends are exchanged
  //! (Etherington's reciprocity) and for all observers.
  double spread;
};

//! Which properties of a ray between a lamp and a point are computed.
enum class LightRayParts {
  way,    //!< direction and travel time
  spread  //!< direction, time and the spread of the ray's bundle
};

inline namespace ERGO_TARGET {

namespace detail {

//! Returns the direction from which arriving light seems to come, for the observer without angular
//! momentum at the point of arrival.
ERGO_HD Vector3<double> seen_from(const LocalFrame& frame, double r, const Arrival& arrival) {
  const Vector3<double> turn = in_axes(frame, arrival.polar_momentum);
  const Vector3<double>& by = frame.normal_by;
  // Momenta of an orthonormal frame: dr/dλ / √(ΣΔ), dθ/dλ / √Σ, L / (sinθ √(A/Σ)); normal_by has
  // √(Δ/Σ), r/√Σ, r √(Σ/A).
  const Vector3<double> n = {arrival.u_rate * by.y * by.y / by.x, -turn.y * by.y / r, -turn.z * by.z / r};
  return (1.0 / ::sqrt(dot(n, n))) * n;
}

//! Returns whether two points are so near to each other that space between them is flat, and their
//! radii too similar to identify a ray by its arrival at the larger radius.
ERGO_HD bool is_next_to(const Vector3<double>& a, const Vector3<double>& b) {
  constexpr double near = 3e-3;
  const Vector3<double> way = b - a;
  return dot(way, way) < near * near * dot(a, a);
}

//! Returns the spread between points that are next to each other: (distance / energy)², both as the
//! observer measures them.
ERGO_HD double spread_nearby(const LocalFrame& frame, const LightRay& ray) {
  const double lapse = frame.normal_by.x * frame.normal_by.z / frame.normal_by.y;
  const double distance = lapse * ray.travel_time * evaluate(frame.camera.energy, ray.direction);
  return distance * distance;
}

//! Finds the ray from the frame's position to another position, on the first or the second way
//! round the hole. `direction`: on input, for a hole without spin; on output, that of the ray.
//! `phi`: angle between both positions [rad].
ERGO_HD bool aim(const LocalFrame& frame, const RayEnds& ends, int order, double phi, Vector3<double>& direction,
                 RayCorrection& correction, Miss& miss) {
  // From this angle on, the first way passes so close to the hole that its rays change as those of
  // the second do.
  constexpr double next_to_axis = 2.5;
  return order == 1 && phi < next_to_axis ? aim_with_spin(frame, ends, direction, correction, miss)
                                          : aim_round_with_spin(frame, ends, order, direction, correction, miss);
}

}  // namespace detail

//! Finds the light from a lamp to a point, on the first or the second way round the hole. Without
//! spin it is in closed form (kernels/spacetime/schwarzschild). With spin, and for its spread, it
//! is found by Newton's method on exact rays, which start at the end that is nearer to the hole.
//! Returns false if no ray is found. `correction` is what the spin adds to the ray of that way: on
//! input for a nearby point, on output for this one.
ERGO_HD_CALLED bool light_ray(Spacetime spacetime, const LocalFrame& frame, const Vector3<double>& point,
                              const Vector3<double>& lamp, int order, LightRayParts parts, RayCorrection& correction,
                              LightRay& ray) {
  const ConnectionPlane plane = connection_plane(lamp, point);
  if (!(plane.r > 2.0)) {
    return false;
  }
  const ConnectingRay flat = connecting_ray(plane.r_observer, plane.r, image_angle(plane.phi, order));
  const ApparentPosition position = apparent_position(plane, order, flat.xi, flat.travel_time, flat.emission_angle);
  ray = {in_axes(frame, position.emission_direction), position.travel_time, 0.0};
  if (spacetime.spin == 0.0 && parts == LightRayParts::way) {
    return true;
  }
  detail::Miss miss{};
  bool found = false;
  if (plane.r <= plane.r_observer) {
    constexpr double near_enough = 2e-4;
    found = detail::aim(frame, {point, lamp, near_enough}, order, plane.phi, ray.direction, correction, miss);
    ray = {ray.direction, miss.arrival.delay, miss.spread};
  } else {
    // From the lamp to the point, time is reversed, and so is the hole's rotation. Miss::arrival
    // belongs to the ray before the last Newton step, so near_enough is smaller here.
    constexpr double near_enough = 1e-5;
    const LocalFrame at_lamp = local_frame(Spacetime{-spacetime.spin}, lamp);
    Vector3<double> direction = in_axes(at_lamp, position.direction);
    found = detail::aim(at_lamp, {lamp, point, near_enough}, order, plane.phi, direction, correction, miss);
    ray = {detail::seen_from(frame, plane.r, miss.arrival), miss.arrival.delay, miss.spread};
  }
  if (order == 1 && detail::is_next_to(point, lamp)) {
    ray = found ? ray : LightRay{in_axes(frame, position.emission_direction), position.travel_time, 0.0};
    ray.spread = detail::spread_nearby(frame, ray);
    return true;
  }
  return found;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
