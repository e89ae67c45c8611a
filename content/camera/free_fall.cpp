#include "content/camera/free_fall.h"

#include <algorithm>
#include <cmath>

#include "content/camera/camera_path.h"
#include "content/camera/rain_pose.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double step_error = 1e-13;
constexpr std::size_t max_steps = 200'000;
//! Distance from the horizon at which a fall ends if it may not cross the horizon [M].
constexpr double horizon_gap = 1e-6;
//! Latest show time up to which it is determined when a fall reaches the horizon or its clock stops
//! [s].
constexpr double end_of_time_s = 1e12;
//! Minimum change since the last turning point, or since the start, for another turning point to
//! count: relative change of the radius, or change of the polar angle [rad]. Smaller changes are
//! rounding errors of a circle.
constexpr double min_swing = 1e-7;

double radius_of(const OrbitState& s) { return 1.0 / s.u; }

double polar_angle_of(const OrbitState& s) { return std::atan2(std::hypot(s.m.x, s.m.y), s.m.z); }

glm::dvec3 direction_in_space(const OrbitState& s) {
  const double c = std::cos(s.drag);
  const double d = std::sin(s.drag);
  return glm::normalize(glm::dvec3(c * s.m.x - d * s.m.y, d * s.m.x + c * s.m.y, s.m.z));
}

//! Returns the azimuth of the falling camera; `on_axis` where it is undefined.
double azimuth_of(const OrbitState& s, double on_axis) {
  return std::hypot(s.m.x, s.m.y) > 1e-150 ? std::atan2(s.m.y, s.m.x) + s.drag : on_axis;
}

//! Returns the rotation by the smallest angle that turns one unit vector into another. The vectors
//! must not be opposite.
glm::dquat min_turn(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  return glm::normalize(glm::dquat(1.0 + glm::dot(from, to), axis.x, axis.y, axis.z));
}

}  // namespace

FreeFall::FreeFall(Spacetime spacetime, const FallStart& start, const FallSettings& settings, const Animation* clock,
                   double end_s)
    : spacetime_(spacetime),
      start_(start),
      settings_(settings),
      leads_within_(settings.least_r > 0.0 && settings.least_r < horizon_radius(spacetime)),
      clock_(settings, clock),
      min_r_(start.r),
      followed_s_(settings.time_s) {
  begin();
  const double latest_s = std::max(end_s, settings.time_s);
  const double wanted = clock_.proper_time(latest_s);
  follow(wanted);
  if (leads_within_ && !crossing_) {
    leads_within_ = false;
    stations_.clear();
    begin();
    follow(wanted);
  }
  const double reached = stations_.back().proper_time;
  followed_s_ = reached < wanted ? clock_.time_s(reached, latest_s).value_or(latest_s) : latest_s;
  if (crossing_) {
    horizon_s_ = clock_.time_s(*crossing_, end_of_time_s);
  }
  note_turns();
  for (FallTurn& turn : turns_) {
    turn.time_s = clock_.time_s(turn.time_s, latest_s).value_or(latest_s);
    min_r_ = std::min(min_r_, turn.r);
  }
}

void FreeFall::begin() {
  OrbitState first = make_orbit(spacetime_, start_.r, start_.theta, start_.phi, start_.velocity);
  constants_ = orbit_constants(spacetime_, first);
  if (!leads_within_) {
    stations_.push_back({0.0, first, start_.phi, 0.0, spherical_frame(start_.theta, start_.phi)});
    return;
  }
  constants_.ingoing = true;
  first.drag = ingoing_turn(spacetime_, start_.r);
  const double phi = start_.phi + first.drag;
  const Vector3<double> in_rain = orbit_rain_velocity(spacetime_, constants_, first, start_.phi);
  const glm::dquat turn = rain_turn(spacetime_, start_.r, start_.theta, start_.velocity, in_rain);
  stations_.push_back({0.0, first, phi, 0.0, spherical_frame(start_.theta, phi) * turn});
}

FreeFall::Station FreeFall::station_after(const Station& from, double proper_time) const {
  Station to = from;
  to.proper_time = proper_time;
  if (proper_time != from.proper_time) {
    to.state = orbit_step(spacetime_, constants_, proper_time - from.proper_time, from.state).end;
  }
  to.phi = from.phi + std::remainder(azimuth_of(to.state, from.phi) - from.phi, 2.0 * pi);
  const glm::dvec3 before = direction_in_space(from.state);
  const glm::dvec3 after = direction_in_space(to.state);
  to.swept = from.swept + std::atan2(glm::length(glm::cross(before, after)), glm::dot(before, after));
  to.frame = min_turn(before, after) * from.frame;
  return to;
}

FreeFall::Station FreeFall::station_at(double proper_time) const {
  const double reached = std::clamp(proper_time, 0.0, stations_.back().proper_time);
  const auto after = std::ranges::upper_bound(stations_, reached, {}, &Station::proper_time);
  return station_after(*(after - 1), reached);
}

void FreeFall::follow(double proper_time) {
  const double horizon = horizon_radius(spacetime_);
  double h = 0.01 * start_.r;
  for (std::size_t step = 0; step < max_steps && stations_.back().proper_time < proper_time; ++step) {
    const Station& from = stations_.back();
    const OrbitStep next = orbit_step(spacetime_, constants_, h, from.state);
    if (next.error <= step_error) {
      const double to = from.proper_time + h;
      const double last_r = leads_within_ ? settings_.least_r : std::max(settings_.least_r, horizon + horizon_gap);
      if (leads_within_ && radius_of(from.state) > horizon && !(radius_of(next.end) > horizon)) {
        crossing_ = time_at_radius(from, to, horizon);
      }
      if (!(radius_of(next.end) > last_r)) {
        return end_at_radius(from, to, last_r);
      }
      stations_.push_back(station_after(from, to));
    }
    h *= orbit_step_growth(next.error, step_error);
  }
}

//! Returns the last proper time in a step at which the radius is still above r.
double FreeFall::time_at_radius(const Station& from, double to, double r) const {
  double outside = from.proper_time;
  double inside = to;
  for (int i = 0; i < 100; ++i) {
    const double middle = outside + 0.5 * (inside - outside);
    (radius_of(station_after(from, middle).state) > r ? outside : inside) = middle;
  }
  return outside;
}

void FreeFall::end_at_radius(const Station& from, double to, double r) {
  const double outside = time_at_radius(from, to, r);
  if (settings_.least_r > 0.0) {
    clock_.stop_at(outside);
    stop_s_ = clock_.time_s(outside, end_of_time_s);
  } else {
    horizon_s_ = clock_.time_s(outside, end_of_time_s);
  }
  if (outside > from.proper_time) {
    stations_.push_back(station_after(from, outside));
  }
}

//! A quantity that oscillates between turning points: the radius, or the polar angle.
struct FreeFall::Swing {
  FallTurn::Kind after_rise;
  FallTurn::Kind after_fall;
  double (*rate)(const OrbitState&);
  double (*measure)(const OrbitState&);
  double last;  //!< value of `measure` at the last turning point, or at the beginning
};

//! Records a turning point of the quantity of `swing` (r or θ) if there is one between two
//! stations. FallTurn::time_s holds its proper time until the constructor replaces it by the show
//! time.
void FreeFall::note_turn(const Station& from, const Station& to, Swing& swing) {
  const bool rises = swing.rate(from.state) > 0.0;
  const bool has_swung = std::abs(swing.measure(from.state) - swing.last) > 0.5 * min_swing;
  if (!has_swung || rises == (swing.rate(to.state) > 0.0)) {
    return;
  }
  double before = from.proper_time;
  double after = to.proper_time;
  for (int i = 0; i < 60; ++i) {
    const double middle = before + 0.5 * (after - before);
    ((swing.rate(station_after(from, middle).state) > 0.0) == rises ? before : after) = middle;
  }
  const OrbitState turn = station_after(from, after).state;
  if (std::abs(swing.measure(turn) - swing.last) > min_swing) {
    turns_.push_back({rises ? swing.after_rise : swing.after_fall, after, radius_of(turn), polar_angle_of(turn)});
    swing.last = swing.measure(turn);
  }
}

void FreeFall::note_turns() {
  const auto log_radius = [](const OrbitState& s) { return -std::log(s.u); };
  const OrbitState& first = stations_.front().state;
  Swing radial = {FallTurn::Kind::nearest, FallTurn::Kind::farthest, [](const OrbitState& s) { return s.u_rate; },
                  log_radius, log_radius(first)};
  Swing polar = {FallTurn::Kind::northernmost, FallTurn::Kind::southernmost,
                 [](const OrbitState& s) { return s.m_rate.z; }, polar_angle_of, polar_angle_of(first)};
  for (std::size_t i = 1; i < stations_.size(); ++i) {
    note_turn(stations_[i - 1], stations_[i], radial);
    note_turn(stations_[i - 1], stations_[i], polar);
    min_r_ = std::min(min_r_, radius_of(stations_[i].state));
  }
  std::ranges::sort(turns_, {}, &FallTurn::time_s);
}

double FreeFall::proper_time(double time_s) const {
  return std::min(clock_.proper_time(time_s), stations_.back().proper_time);
}

double FreeFall::swept_angle(double time_s) const { return station_at(clock_.proper_time(time_s)).swept; }

FallPosition FreeFall::at(double time_s) const {
  const Station now = station_at(clock_.proper_time(time_s));
  const double r = radius_of(now.state);
  const double theta = polar_angle_of(now.state);
  const double psi = now.phi - now.state.drag;
  const glm::dquat frame = glm::normalize(glm::conjugate(spherical_frame(theta, now.phi)) * now.frame);
  if (!leads_within_) {
    return {r, theta, now.phi, orbit_velocity(spacetime_, now.state, psi), frame};
  }
  const double phi = r > horizon_radius(spacetime_) ? now.phi - ingoing_turn(spacetime_, r) : now.phi;
  return {r, theta, phi, orbit_rain_velocity(spacetime_, constants_, now.state, psi), frame};
}

}  // namespace ergodome
