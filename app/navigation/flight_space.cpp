#include "app/navigation/flight_space.h"

#include <algorithm>
#include <cmath>

#include "content/fall/within.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Part of the guard's radius that is added to the height above it, where speeds are counted in it.
constexpr double leeway = 0.05;
//! A camera at the guard stays this part of its radius above it: enough for a radius to be told from the guard's.
constexpr double least_height = 1e-9;
//! How far outside the horizon its guard is [M].
constexpr double above_horizon = 0.02;

//! Lengths per coordinate at a place: along the radius and the meridian, and how much shorter steps to the east are than those.
struct LocalScale {
  double radial;    //!< dr per proper length
  double southern;  //!< angle per proper length [1/M]
  double eastern;   //!< the same along the circle of latitude; equal on the axis
};

LocalScale local_scale(double spin, const CameraPlace& place) {
  const glm::dvec3& n = place.towards;
  const KerrFunctions f = kerr_functions(spin, place.r, std::atan2(std::hypot(n.x, n.y), n.z));
  return {std::sqrt(std::max(f.delta, 0.0) / f.sigma), 1.0 / std::sqrt(f.sigma), 1.0 / f.circumference_factor};
}

//! The same for who may be on both sides of the horizon, where lengths are those of r and of angles times r.
LocalScale scale_at(double spin, const CameraPlace& place, bool through_horizon) {
  return through_horizon ? LocalScale{1.0, 1.0 / place.r, 1.0 / place.r} : local_scale(spin, place);
}

}  // namespace

double guard_radius(double spin, const FlightSettings& settings) {
  const double guard = settings.guard == FlightGuard::horizon
                           ? horizon_radius(spin) + above_horizon
                           : 1.01 * std::max(photon_orbit_radius(spin, 1.0), photon_orbit_radius(spin, -1.0));
  return std::max(guard, settings.least_r);
}

bool is_beyond_return(double spin, double r) { return !(r > nearest_rest * horizon_radius(spin)); }

bool may_fall_through_horizon(const Show& show) {
  const FlightSettings& flight = show.flight;
  return !kept_outside(show) && flight.guard == FlightGuard::horizon &&
         flight.least_r <= horizon_radius(show.spin) + above_horizon;
}

FlightSpace::FlightSpace(double spin, const FlightSettings& settings, double guard_r, bool through_horizon)
    : spin_(spin),
      guard_r_(guard_r),
      most_r_(std::max(settings.most_r, 1.1 * guard_r)),
      fastest_(settings.max_speed),
      through_horizon_(through_horizon) {}

FlightSpace::FlightSpace(double spin, const FlightSettings& settings)
    : FlightSpace(spin, settings, guard_radius(spin, settings), false) {}

FlightSpace FlightSpace::through_horizon(double spin, const FlightSettings& settings) {
  return {spin, settings, deepest_rest(spin), true};
}

double FlightSpace::distance(double r) const { return std::max(r - guard_r_, 0.0) + leeway * guard_r_; }

double FlightSpace::slowing(double r, double speed) const {
  const double room = speed < 0.0 ? r - guard_r_ : most_r_ - r;
  const double fastest = fastest_ * std::max(room, 0.0);
  return std::abs(speed) > fastest ? fastest / std::abs(speed) : 1.0;
}

double FlightSpace::moved_radius(double r, double speed, double seconds) const {
  const double lowest = guard_r_ * (1.0 + least_height);
  if (r < lowest) {
    // A show's path may lead where visitors may not go.
    const double out = std::max(speed, fastest_ * (lowest - r + leeway * guard_r_));
    return r + out * seconds;
  }
  if (speed < 0.0) {
    const double height = r - guard_r_;
    return std::max(guard_r_ + height * std::exp(-std::min(-speed / height, fastest_) * seconds), lowest);
  }
  const double room = most_r_ - r;
  if (!(room > 0.0)) {
    return r;
  }
  return r - room * std::expm1(-std::min(speed / room, fastest_) * seconds);
}

void FlightSpace::move(CameraPlace& place, const glm::dvec3& velocity, double seconds) const {
  const LocalScale scale = scale_at(spin_, place, through_horizon_);
  const double length = distance(place.r);
  const glm::dvec3& n = place.towards;
  const double outward = glm::dot(velocity, n);
  const glm::dvec3 across = velocity - outward * n;
  const glm::dvec3 east = east_at(n);
  const glm::dvec3 step = scale.southern * across + ((scale.eastern - scale.southern) * glm::dot(across, east)) * east;
  const double r = place.r;
  place.r = moved_radius(r, outward * scale.radial * length, seconds);
  place.towards = moved_on_sphere(n, (length * seconds) * step);
}

glm::dvec3 FlightSpace::velocity(const CameraPlace& place, double r_rate, const glm::dvec3& towards_rate) const {
  const LocalScale scale = scale_at(spin_, place, through_horizon_);
  const glm::dvec3& n = place.towards;
  const glm::dvec3 east = east_at(n);
  const glm::dvec3 across = towards_rate - glm::dot(towards_rate, n) * n;
  const glm::dvec3 length = across / scale.southern +
                            ((1.0 / scale.eastern - 1.0 / scale.southern) * glm::dot(across, east)) * east +
                            (r_rate / std::max(scale.radial, 1e-9)) * n;
  return length / distance(place.r);
}

}  // namespace ergodome
