#include "content/camera/hole_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

//! Maximum error of a step along the orbit, as an angle [rad].
constexpr double clock_step_error = 1e-12;
constexpr std::size_t max_clock_steps = 1'000'000;

//! Returns the difference between the time of ingoing Kerr coordinates, t + ∫ (r² + a²) / Δ dr, and
//! that of ingoing_lag(), t + ∫ 2 r_+ / Δ dr, up to a constant [M]: ∫ (r + r_+) / (r - r_-) dr.
//! Here a is the spin, Δ = r² - 2 r + a², and r_± are the radii of the horizons.
double ahead_of_lag(Spacetime spacetime, double r) { return r + 2.0 * std::log(r - inner_horizon_radius(spacetime)); }

//! Returns the integral, from 0 to a time, of a factor that falls smoothly from 1 at time 0 to 0 at
//! `ease_s` [s].
double eased_away_s(double time_s, double ease_s) {
  if (!(time_s > 0.0)) {
    return 0.0;
  }
  if (!(time_s < ease_s)) {
    return 0.5 * ease_s;
  }
  const double s = time_s / ease_s;
  // The integral of 1 - eased(s).
  return ease_s * s * (1.0 - s * s * s * (2.5 + s * (s - 3.0)));
}

}  // namespace

HoleClock::HoleClock(Spacetime spacetime, std::shared_ptr<const FreeFall> orbit, double pace)
    : spacetime_(spacetime), orbit_(std::move(orbit)), pace_(pace) {
  if (orbit_ != nullptr) {
    follow();
  }
}

void HoleClock::follow() {
  const FallStart& start = orbit_->start();
  const OrbitState first = make_orbit(spacetime_, start.r, start.theta, start.phi, start.velocity);
  constants_ = orbit_constants(spacetime_, first);
  constants_.ingoing = orbit_->leads_within();
  stations_.push_back({0.0, first});
  const double wanted = orbit_->proper_time(orbit_->followed_s());
  double h = 0.01 * start.r;
  for (std::size_t step = 0; step < max_clock_steps && stations_.back().proper_time < wanted; ++step) {
    const Station& from = stations_.back();
    const OrbitStep next = orbit_step(spacetime_, constants_, h, from.state);
    if (next.error <= clock_step_error) {
      stations_.push_back({from.proper_time + h, next.end});
    }
    h *= orbit_step_growth(next.error, clock_step_error);
  }
}

double HoleClock::time_along_orbit(double time_s) const {
  const double proper_time = std::min(orbit_->proper_time(time_s), stations_.back().proper_time);
  const auto after = std::ranges::upper_bound(stations_, proper_time, {}, &Station::proper_time);
  const Station& from = *(after - 1);
  const OrbitState at = orbit_step(spacetime_, constants_, proper_time - from.proper_time, from.state).end;
  return constants_.ingoing
             ? at.time - (ahead_of_lag(spacetime_, 1.0 / at.u) - ahead_of_lag(spacetime_, orbit_->start().r))
             : at.time;
}

double HoleClock::time(double time_s) const {
  if (orbit_ == nullptr || !(time_s > orbit_->begin_s())) {
    return time_s * pace_;
  }
  const double ease_s = orbit_->ease_s();
  double paced_s = orbit_->begin_s() + eased_away_s(time_s - orbit_->begin_s(), ease_s);
  if (const std::optional<double> until_s = orbit_->until_s(); until_s && time_s > *until_s - ease_s) {
    const double left_s = *until_s - time_s;
    paced_s += 0.5 * ease_s - eased_away_s(left_s, ease_s) + std::max(-left_s, 0.0);
  }
  return paced_s * pace_ + time_along_orbit(time_s);
}

}  // namespace ergodome
