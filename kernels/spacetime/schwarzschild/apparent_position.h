#pragma once

#include "kernels/core/vector3.h"
#include "kernels/spacetime/schwarzschild/connecting_ray.h"

// Apparent positions of points near a hole: Müller, Schulz & Weiskopf (2021), sections 2.4, 3.2 and
// 3.3. Points are in pseudo-Cartesian coordinates (the usual ones of r, θ, φ). Directions of static
// observers have components along the same axes: the component along the point's radius is measured
// radially, the others tangentially.
namespace ergodome::inline ERGO_TARGET {

//! The plane through an observer, a point and the center of the hole.
struct ConnectionPlane {
  Vector3<double> outward;  //!< e_1: from the hole to the observer
  Vector3<double> across;   //!< e_2: perpendicular to e_1, on the point's side
  double r_observer;        //!< the observer's radius coordinate [M]
  double r;                 //!< the point's radius coordinate [M]
  double phi;               //!< angle between observer and point about the hole, 0 to π [rad]
};

//! How a static observer sees a point.
struct ApparentPosition {
  Vector3<double> direction;  //!< direction from the observer to the apparent position
  double travel_time;         //!< coordinate time from the point to the observer, used as depth [M]
  //! Direction in which light leaves a static emitter at the point.
  Vector3<double> emission_direction;
};

//! Returns the plane of an observer and a point, neither at r = 0; eq. 15. If they are in line with
//! the hole, every such plane is valid and one is chosen: the image is a ring.
ERGO_HD ConnectionPlane connection_plane(const Vector3<double>& observer, const Vector3<double>& point) {
  ConnectionPlane plane{};
  plane.r_observer = ::sqrt(dot(observer, observer));
  plane.r = ::sqrt(dot(point, point));
  plane.outward = (1.0 / plane.r_observer) * observer;
  const Vector3<double>& e = plane.outward;
  const double along = dot(e, point);
  Vector3<double> rest = point - along * e;
  rest = rest - dot(e, rest) * e;
  const double beside = ::sqrt(dot(rest, rest));
  if (beside > 0.0) {
    plane.across = (1.0 / beside) * rest;
  } else {
    const Vector3<double> axis = ::fabs(e.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
    const Vector3<double> other = axis - dot(axis, e) * e;
    plane.across = (1.0 / ::sqrt(dot(other, other))) * other;
  }
  plane.phi = ::atan2(beside, along);
  return plane;
}

//! Computes the directions in space at both ends of the ray of image `order` >= 1. `xi`,
//! `travel_time` and `emission_angle` are those of the ray that sweeps image_angle(plane.phi,
//! order), from connecting_ray() or a table.
ERGO_HD ApparentPosition apparent_position(const ConnectionPlane& plane, int order, double xi, double travel_time,
                                           double emission_angle) {
  // Rays of odd order leave the observer on the point's side, those of even order on the other.
  const double side = order % 2 == 1 ? 1.0 : -1.0;
  const double cosine = ::cos(plane.phi);
  const double sine = ::sin(plane.phi);
  const Vector3<double> radial = cosine * plane.outward + sine * plane.across;
  const Vector3<double> onward = side * (cosine * plane.across - sine * plane.outward);
  ApparentPosition position{};
  position.direction = ::cos(xi) * plane.outward + side * ::sin(xi) * plane.across;
  position.travel_time = travel_time;
  position.emission_direction = ::cos(emission_angle) * radial - ::sin(emission_angle) * onward;
  return position;
}

//! Computes how a point is seen, without a table.
ERGO_HD ApparentPosition apparent_position(const Vector3<double>& observer, const Vector3<double>& point, int order) {
  const ConnectionPlane plane = connection_plane(observer, point);
  const ConnectingRay ray = connecting_ray(plane.r_observer, plane.r, image_angle(plane.phi, order));
  return apparent_position(plane, order, ray.xi, ray.travel_time, ray.emission_angle);
}

//! Returns ν_observed / ν_emitted between a static emitter and a static observer.
ERGO_HD double static_frequency_ratio(double r_emitter, double r_observer) {
  return detail::lapse(r_emitter) / detail::lapse(r_observer);
}

//! Returns the illuminance of a surface at rest by a point light at rest, through one ray (order 1
//! or 2; add both): eqs. 20 and 21, with the angle that a static observer at the surface measures.
//! `normal` is the surface's unit normal in pseudo-Cartesian coordinates. A source of strength
//! `strength` gives strength / d² at a distance d far from the hole.
ERGO_HD double illuminance(const Vector3<double>& light, const Vector3<double>& point, const Vector3<double>& normal,
                           int order, double strength) {
  const ApparentPosition position = apparent_position(light, point, order);
  const double r = ::sqrt(dot(point, point));
  const Vector3<double> radial = (1.0 / r) * point;
  // Measured lengths along the radius are longer by 1/√(1 - 2/r). The surface remains the same, so
  // that component of its normal shrinks.
  const Vector3<double> measured = normal + (detail::lapse(r) - 1.0) * dot(normal, radial) * radial;
  const double cosine = dot(measured, position.emission_direction) / ::sqrt(dot(measured, measured));
  return strength * ::fmax(0.0, cosine) / (position.travel_time * position.travel_time);
}

}  // namespace ergodome::inline ERGO_TARGET
