#include "app/navigation/orbit_ride.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/observer_mode.h"
#include "app/navigation/turn_limits.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! A round takes this long, unless a visitor hurries.
constexpr double round_s = 40.0;
//! Part of the acceleration that comfort allows which the orbit itself may take.
constexpr double bend_part = 0.3;
constexpr double tolerance = 1e-11;
constexpr int step_limit = 400;

glm::dvec3 direction_of(const OrbitState& s) {
  const double c = std::cos(s.drag);
  const double d = std::sin(s.drag);
  return glm::normalize(glm::dvec3(c * s.m.x - d * s.m.y, d * s.m.x + c * s.m.y, s.m.z));
}

OrbitState orbit_at(double spin, const CameraPlace& place, const Vector3<double>& velocity) {
  const CameraPose pose = pose_of(place);
  return make_orbit(spin, pose.r, pose.theta, pose.phi, velocity);
}

}  // namespace

Vector3<double> circular_velocity(double spin, double r, double theta, double sense) {
  return nearest_velocity(sense > 0.0 ? ObserverMotion::geodesic : ObserverMotion::retrograde, spin, r, theta).velocity;
}

OrbitRide::OrbitRide(const FlightSpace& space, const FlightSettings& settings, const CameraPlace& place,
                     const Vector3<double>& velocity)
    : space_(space),
      orbit_(orbit_at(space.spin(), place, velocity)),
      constants_(orbit_constants(space.spin(), orbit_)),
      usual_clock_(2.0 * pi * place.r * std::sqrt(place.r) / round_s),
      fastest_turn_(turn_limits(settings.comfort).around),
      fastest_(settings.max_speed),
      accel_(settings.comfort.accel) {}

bool OrbitRide::take_over(const CameraPlace& place, const glm::dvec3& velocity) {
  constexpr double across_at_most = 0.02;  // nobody sees a camera change so little [distances/s]
  const OrbitState now = rate();
  const double r = 1.0 / orbit_.u;
  const glm::dvec3 axis(0.0, 0.0, 1.0);
  const glm::dvec3 turned = glm::angleAxis(orbit_.drag, axis) * glm::dvec3(now.m.x, now.m.y, now.m.z);
  const glm::dvec3 along = space_.velocity(place, -now.u * r * r, turned + now.drag * glm::cross(axis, place.towards));
  const double clock = std::max(glm::dot(velocity, along) / glm::dot(along, along), 0.0);
  if (!(glm::length(velocity - clock * along) <= across_at_most)) {
    return false;
  }
  clock_ = clock;
  taken_over_ = true;
  return true;
}

double OrbitRide::comfortable_clock(double reach) const {
  const OrbitState now = rate();
  const double turn = std::sqrt(dot(now.m, now.m)) + std::abs(now.drag);
  // The orbit's own bend, and the scale of distances that changes on the way, take a part of the acceleration.
  const double bend = (1.0 / reach + 2.0 * turn) / reach;
  const double fastest =
      std::min({fastest_turn_ / std::max(turn, 1e-12), fastest_ * reach, std::sqrt(bend_part * accel_ / bend)});
  // An orbit that falls far out may be watched; what it comes near to slows it.
  return std::min(fastest, 1e6 * usual_clock_);
}

double OrbitRide::slowed(double clock) const {
  const double r = 1.0 / orbit_.u;
  return clock * space_.slowing(r, -rate().u * r * r * clock);
}

void OrbitRide::advance(double seconds, double hurry, CameraPlace& place) {
  const Vector3<double> v = velocity();
  const double beta = std::sqrt(dot(v, v));
  const double length_per_clock = std::max(beta / std::sqrt(1.0 - beta * beta), 1e-6);
  const double reach = space_.distance(place.r) / length_per_clock;  // clock in a distance
  const double change = (1.0 - 2.0 * bend_part) * accel_ * seconds * reach;
  const double comfortable = comfortable_clock(reach);
  taken_over_ = taken_over_ && clock_ > comfortable;
  const double limit = slowed(taken_over_ ? std::max(comfortable, clock_ - change) : comfortable);
  const double wish = std::min(usual_clock_ * (1.0 + 3.0 * std::clamp(hurry, 0.0, 1.0)), limit);
  held_ = limit < 0.05 * std::min(usual_clock_, fastest_ * reach);
  clock_ = std::min(clock_ + std::clamp(wish - clock_, -change, change), limit);
  const OrbitState before = orbit_;
  advance_orbit(space_.spin(), constants_, clock_ * seconds, tolerance, step_limit, orbit_);
  const double r = 1.0 / orbit_.u;
  const bool inside = !(r > space_.guard_r()) && r < place.r;
  if (inside || !std::isfinite(r + orbit_.drag + orbit_.m.x + orbit_.m.y + orbit_.m.z)) {
    orbit_ = before;
    clock_ = 0.0;
    held_ = true;
  }
  place.r = 1.0 / orbit_.u;
  place.towards = direction_of(orbit_);
}

}  // namespace ergodome
