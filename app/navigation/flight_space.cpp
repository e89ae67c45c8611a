#include "app/navigation/flight_space.h"

#include <algorithm>
#include <cmath>

#include "content/camera/within.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Speeds are in units of the height above the guard plus this fraction of the guard's radius.
constexpr double leeway = 0.05;
//! Minimum height of a camera above the guard, as a fraction of the guard's radius: enough to
//! distinguish the two radii.
constexpr double min_height = 1e-9;
//! Height of the guard above the horizon [M].
constexpr double above_horizon = 0.02;

//! Coordinate change per proper length at a position: along the radius, the meridian and the circle
//! of latitude.
struct LocalScale {
  double radial;    //!< dr per proper length
  double southern;  //!< change of the polar angle per proper length along the meridian [1/M]
  //! Along the circle of latitude: sinθ times the change of azimuth, per proper length [1/M]. On
  //! the spin axis it equals `southern`.
  double eastern;
};

LocalScale local_scale(Spacetime spacetime, const CameraPlacement& placement) {
  const glm::dvec3& n = placement.towards;
  const KerrFunctions f = kerr_functions(spacetime, placement.r, std::atan2(std::hypot(n.x, n.y), n.z));
  return {std::sqrt(std::max(f.delta, 0.0) / f.sigma), 1.0 / std::sqrt(f.sigma), 1.0 / f.circumference_factor};
}

//! Returns local_scale(), or, for cameras that may cross the horizon, the scale of coordinate
//! lengths: r, and angles times r.
LocalScale scale_at(Spacetime spacetime, const CameraPlacement& placement, bool through_horizon) {
  return through_horizon ? LocalScale{1.0, 1.0 / placement.r, 1.0 / placement.r} : local_scale(spacetime, placement);
}

}  // namespace

double guard_radius(Spacetime spacetime, const FlightSettings& settings) {
  const double guard = settings.guard == FlightGuard::horizon
                           ? horizon_radius(spacetime) + above_horizon
                           : 1.01 * std::max(photon_orbit_radius(spacetime, 1.0), photon_orbit_radius(spacetime, -1.0));
  return std::max(guard, settings.least_r);
}

bool is_beyond_return(Spacetime spacetime, double r) { return !(r > nearest_rest * horizon_radius(spacetime)); }

bool may_fall_through_horizon(const Show& show) {
  const FlightSettings& flight = show.flight;
  return !kept_outside(show) && flight.guard == FlightGuard::horizon &&
         flight.least_r <= horizon_radius(spacetime_of(show)) + above_horizon;
}

FlightSpace::FlightSpace(Spacetime spacetime, const FlightSettings& settings, double guard_r, bool through_horizon)
    : spacetime_(spacetime),
      guard_r_(guard_r),
      max_r_(std::max(settings.most_r, 1.1 * guard_r)),
      fastest_(settings.max_speed),
      through_horizon_(through_horizon) {}

FlightSpace::FlightSpace(Spacetime spacetime, const FlightSettings& settings)
    : FlightSpace(spacetime, settings, guard_radius(spacetime, settings), false) {}

FlightSpace FlightSpace::through_horizon(Spacetime spacetime, const FlightSettings& settings) {
  return {spacetime, settings, deepest_rest(spacetime), true};
}

double FlightSpace::distance(double r) const { return std::max(r - guard_r_, 0.0) + leeway * guard_r_; }

double FlightSpace::slowing(double r, double speed) const {
  const double room = speed < 0.0 ? r - guard_r_ : max_r_ - r;
  const double fastest = fastest_ * std::max(room, 0.0);
  return std::abs(speed) > fastest ? fastest / std::abs(speed) : 1.0;
}

double FlightSpace::moved_radius(double r, double speed, double seconds) const {
  const double lowest = guard_r_ * (1.0 + min_height);
  if (r < lowest) {
    // A show's path may lead inside the guard. A camera that leaves the path there moves outward,
    // whatever is steered.
    const double out = std::max(speed, fastest_ * (lowest - r + leeway * guard_r_));
    return r + out * seconds;
  }
  if (speed < 0.0) {
    const double height = r - guard_r_;
    return std::max(guard_r_ + height * std::exp(-std::min(-speed / height, fastest_) * seconds), lowest);
  }
  const double room = max_r_ - r;
  if (!(room > 0.0)) {
    return r;
  }
  return r - room * std::expm1(-std::min(speed / room, fastest_) * seconds);
}

void FlightSpace::move(CameraPlacement& placement, const glm::dvec3& velocity, double seconds) const {
  const LocalScale scale = scale_at(spacetime_, placement, through_horizon_);
  const double length = distance(placement.r);
  const glm::dvec3& n = placement.towards;
  const double outward = glm::dot(velocity, n);
  const glm::dvec3 across = velocity - outward * n;
  const glm::dvec3 east = east_at(n);
  const glm::dvec3 step = scale.southern * across + ((scale.eastern - scale.southern) * glm::dot(across, east)) * east;
  const double r = placement.r;
  placement.r = moved_radius(r, outward * scale.radial * length, seconds);
  placement.towards = moved_on_sphere(n, (length * seconds) * step);
}

glm::dvec3 FlightSpace::velocity(const CameraPlacement& placement, double r_rate,
                                 const glm::dvec3& towards_rate) const {
  const LocalScale scale = scale_at(spacetime_, placement, through_horizon_);
  const glm::dvec3& n = placement.towards;
  const glm::dvec3 east = east_at(n);
  const glm::dvec3 across = towards_rate - glm::dot(towards_rate, n) * n;
  const glm::dvec3 length = across / scale.southern +
                            ((1.0 / scale.eastern - 1.0 / scale.southern) * glm::dot(across, east)) * east +
                            (r_rate / std::max(scale.radial, 1e-9)) * n;
  return length / distance(placement.r);
}

}  // namespace ergodome
