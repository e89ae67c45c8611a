#include "app/navigation/orbit_ride.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/observer_mode.h"
#include "app/navigation/turn_limits.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/geodesic/rain_orbit.h"

namespace ergodome {

namespace {

//! Time of the visitor's clock for one revolution on a circular orbit at the starting radius. It is
//! shorter if the visitor hurries, and longer if comfort requires that.
constexpr double round_s = 40.0;
//! Time of the visitor's clock in which the remaining proper time of a fall through the horizon
//! decreases to 1/e.
constexpr double fall_s = 6.0;
//! Proper time that is added to the remaining one, so that the fall reaches its end [M].
constexpr double last_proper_time = 0.01;
//! Fraction of the comfortable acceleration that the curvature of the orbit may take, see
//! comfortable_clock(). Changes of the clock rate may take 1 - 2 bend_part.
constexpr double bend_part = 0.3;
constexpr double tolerance = 1e-11;
constexpr int step_limit = 400;

glm::dvec3 direction_of(const OrbitState& s) {
  const double c = std::cos(s.drag);
  const double d = std::sin(s.drag);
  return glm::normalize(glm::dvec3(c * s.m.x - d * s.m.y, d * s.m.x + c * s.m.y, s.m.z));
}

OrbitState orbit_at(Spacetime spacetime, const CameraPlacement& placement, const Vector3<double>& velocity) {
  const CameraPose pose = pose_of(placement);
  return make_orbit(spacetime, pose.r, pose.theta, pose.phi, velocity);
}

//! Returns the rotation from the Boyer-Lindquist azimuth of a pose to the ingoing Kerr azimuth
//! [rad]; 0 inside the horizon, where poses have the latter.
double ingoing_turn_of_pose(Spacetime spacetime, double r) {
  return r > horizon_radius(spacetime) ? ingoing_turn(spacetime, r) : 0.0;
}

}  // namespace

CameraPlacement ingoing_placement(const CameraPose& pose, Spacetime spacetime) {
  CameraPose turned = pose;
  turned.phi += ingoing_turn_of_pose(spacetime, pose.r);
  return placement_of(turned);
}

CameraPose pose_of_ingoing(const CameraPlacement& placement, Spacetime spacetime) {
  CameraPose pose = pose_of(placement);
  pose.phi -= ingoing_turn_of_pose(spacetime, pose.r);
  return pose;
}

Vector3<double> circular_velocity(Spacetime spacetime, double r, double theta, double sense) {
  return nearest_velocity(sense > 0.0 ? ObserverMotion::geodesic : ObserverMotion::retrograde, spacetime, r, theta)
      .velocity;
}

OrbitRide::OrbitRide(const FlightSpace& space, const FlightSettings& settings, double r,
                     const OrbitConstants& constants, const OrbitState& orbit)
    : space_(space),
      orbit_(orbit),
      constants_(constants),
      begin_r_(r),
      fastest_turn_(turn_limits(settings.comfort).around),
      fastest_(settings.max_speed),
      accel_(settings.comfort.accel) {}

OrbitRide::OrbitRide(const FlightSpace& space, const FlightSettings& settings, const CameraPlacement& placement,
                     const Vector3<double>& velocity)
    : OrbitRide(space, settings, placement.r, {}, orbit_at(space.spacetime(), placement, velocity)) {
  constants_ = orbit_constants(space.spacetime(), orbit_);
}

OrbitRide OrbitRide::through_horizon(Spacetime spacetime, const FlightSettings& settings, const CameraPose& pose) {
  const CameraPose placement = pose_of(ingoing_placement(pose, spacetime));
  const RainOrbit orbit = make_rain_orbit(spacetime, placement.r, placement.theta, placement.phi, *pose.velocity);
  OrbitRide ride(FlightSpace::through_horizon(spacetime, settings), settings, placement.r, orbit.constants,
                 orbit.state);
  ride.estimate_left(placement.r);
  return ride;
}

Vector3<double> OrbitRide::velocity() const {
  if (!leads_through_horizon()) {
    return orbit_velocity(space_.spacetime(), orbit_);
  }
  const double azimuth = pose_of({1.0 / orbit_.u, direction_of(orbit_)}).phi;
  return orbit_rain_velocity(space_.spacetime(), constants_, orbit_, azimuth - orbit_.drag);
}

double OrbitRide::radial_speed() const { return -rate().u / (orbit_.u * orbit_.u) * clock_; }

bool OrbitRide::falls_into_hole() const { return falls_in(space_.spacetime(), constants_, orbit_); }

glm::dvec3 OrbitRide::way(const CameraPlacement& placement) const {
  const OrbitState now = rate();
  const double r = 1.0 / orbit_.u;
  const glm::dvec3 axis(0.0, 0.0, 1.0);
  const glm::dvec3 turned = glm::angleAxis(orbit_.drag, axis) * glm::dvec3(now.m.x, now.m.y, now.m.z);
  return space_.velocity(placement, -now.u * r * r, turned + now.drag * glm::cross(axis, placement.towards));
}

double OrbitRide::clock_along(const CameraPlacement& placement, const glm::dvec3& velocity) const {
  const glm::dvec3 along = way(placement);
  return std::max(glm::dot(velocity, along) / std::max(glm::dot(along, along), 1e-12), 0.0);
}

bool OrbitRide::take_over(const CameraPlacement& placement, const glm::dvec3& velocity) {
  // Maximum velocity across the orbit that the camera may lose without a visible jump
  // [distances/s].
  constexpr double across_at_most = 0.02;
  if (!(glm::length(velocity - clock_along(placement, velocity) * way(placement)) <= across_at_most)) {
    return false;
  }
  match_motion(placement, velocity);
  return true;
}

void OrbitRide::match_motion(const CameraPlacement& placement, const glm::dvec3& velocity) {
  clock_ = clock_along(placement, velocity);
  taken_over_ = true;
}

void OrbitRide::take_clock_of(const OrbitRide& other) {
  clock_ = other.clock_;
  taken_over_ = other.taken_over_;
}

double OrbitRide::usual_clock() const {
  // A fall through the horizon slows down in proportion to the remaining time: near its end, there
  // is much to see in little proper time.
  return left_ ? (*left_ + last_proper_time) / fall_s : 2.0 * pi * begin_r_ * std::sqrt(begin_r_) / round_s;
}

double OrbitRide::comfortable_clock(double reach, double usual) const {
  const OrbitState now = rate();
  const double turn = std::sqrt(dot(now.m, now.m)) + std::abs(now.drag);
  // The curvature of the orbit and the changing scale of distances take part of the acceleration.
  const double bend = (1.0 / reach + 2.0 * turn) / reach;
  const double fastest =
      std::min({fastest_turn_ / std::max(turn, 1e-12), fastest_ * reach, std::sqrt(bend_part * accel_ / bend)});
  // Far from the hole the clock may run much faster than usual; it slows down when the orbit
  // approaches the hole.
  return std::min(fastest, 1e6 * usual);
}

double OrbitRide::slowed(double clock) const {
  constexpr double at_rest = 1e-6;
  const double r = 1.0 / orbit_.u;
  if (leads_through_horizon() && r < space_.guard_r() * (1.0 + at_rest)) {
    return 0.0;
  }
  return clock * space_.slowing(r, -rate().u * r * r * clock);
}

void OrbitRide::estimate_left(double r) {
  left_ = time_to_deepest();
  left_estimated_at_r_ = r;
}

//! Integrates the orbit ahead with a coarse tolerance to the smallest radius. Returns nothing if
//! that takes too many steps.
std::optional<double> OrbitRide::time_to_deepest() const {
  constexpr double coarse = 1e-8;
  constexpr int max_steps = 2000;
  OrbitState ahead = orbit_;
  double time = 0.0;
  double h = 0.01 / orbit_.u;
  for (int step = 0; step < max_steps; ++step) {
    const OrbitStep next = orbit_step(space_.spacetime(), constants_, h, ahead);
    const bool over = 1.0 / next.end.u < space_.guard_r();
    if (next.error <= coarse && !over) {
      ahead = next.end;
      time += h;
    }
    h *= over ? 0.5 : orbit_step_growth(next.error, coarse);
    if (over && h < 1e-6) {
      return time;
    }
  }
  return std::nullopt;
}

void OrbitRide::advance(double seconds, double hurry, CameraPlacement& placement) {
  const double min_way = 1e-6 / space_.distance(placement.r);
  const double reach = 1.0 / std::max(glm::length(way(placement)), min_way);
  const double usual = usual_clock();
  const double change = (1.0 - 2.0 * bend_part) * accel_ * seconds * reach;
  const double comfortable = comfortable_clock(reach, usual);
  taken_over_ = taken_over_ && clock_ > comfortable;
  const double limit = slowed(taken_over_ ? std::max(comfortable, clock_ - change) : comfortable);
  const double wish = std::min(usual * (1.0 + 3.0 * std::clamp(hurry, 0.0, 1.0)), limit);
  held_ = limit < 0.05 * std::min(usual, fastest_ * reach);
  clock_ = std::min(clock_ + std::clamp(wish - clock_, -change, change), limit);
  const OrbitState before = orbit_;
  advance_orbit(space_.spacetime(), constants_, clock_ * seconds, tolerance, step_limit, orbit_);
  const double r = 1.0 / orbit_.u;
  const bool inside = !(r > space_.guard_r()) && r < placement.r;
  if (inside || !std::isfinite(r + orbit_.drag + orbit_.m.x + orbit_.m.y + orbit_.m.z)) {
    orbit_ = before;
    clock_ = 0.0;
    held_ = true;
  } else if (left_) {
    left_ = std::max(*left_ - clock_ * seconds, 0.0);
    // Integrates `left_` again during the fall, because a relative error that is small at first is
    // large compared with the little time left near its end.
    constexpr double nearer = 0.7;
    if (1.0 / orbit_.u < nearer * left_estimated_at_r_) {
      estimate_left(1.0 / orbit_.u);
    }
  }
  proper_time_ += clock_ * seconds;
  placement.r = 1.0 / orbit_.u;
  placement.towards = direction_of(orbit_);
}

}  // namespace ergodome
