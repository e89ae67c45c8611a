#include "content/camera/fall_clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "content/show/animated_show.h"
#include "content/timeline/key_curve.h"

namespace ergodome {

namespace {

struct GaussNode {
  double position;
  double weight;
};

//! Gauss-Legendre nodes on [0, 1] (Abramowitz & Stegun, table 25.4, n = 6): exact for polynomials
//! up to degree 11. An animated number and its easing are polynomials of degree 5.
constexpr std::array<GaussNode, 6> gauss_nodes = {{
    {0.5 - 0.5 * 0.932469514203152028, 0.5 * 0.171324492379170345},
    {0.5 - 0.5 * 0.661209386466264514, 0.5 * 0.360761573048138608},
    {0.5 - 0.5 * 0.238619186083196909, 0.5 * 0.467913934572691047},
    {0.5 + 0.5 * 0.238619186083196909, 0.5 * 0.467913934572691047},
    {0.5 + 0.5 * 0.661209386466264514, 0.5 * 0.360761573048138608},
    {0.5 + 0.5 * 0.932469514203152028, 0.5 * 0.171324492379170345},
}};

}  // namespace

FallClock::FallClock(const FallSettings& settings, const Animation* changing)
    : begin_s_(settings.time_s), end_s_(settings.until_s.value_or(INFINITY)), ease_s_(settings.ease_s) {
  clock_ = changing != nullptr ? *changing : Animation{"camera.fall.clock", {{begin_s_, settings.clock}}};
  std::vector<double> begins = {begin_s_, begin_s_ + ease_s_};
  if (settings.until_s) {
    begins.insert(begins.end(), {end_s_ - ease_s_, end_s_});
  }
  for (const NumberKey& key : clock_.keys) {
    begins.push_back(std::max(key.time_s, begin_s_));
  }
  std::ranges::sort(begins);
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  double run = 0.0;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    run += i > 0 ? integral(begins[i - 1], begins[i]) : 0.0;
    pieces_.push_back({begins[i], run});
  }
}

double FallClock::rate(double time_s) const {
  const double edge_s = std::min(time_s - begin_s_, end_s_ - time_s);
  const double part = edge_s < 0.0 ? 0.0 : edge_s < ease_s_ ? eased(edge_s / ease_s_) : 1.0;
  return value_at(clock_, time_s) * part;
}

double FallClock::integral(double from_s, double to_s) const {
  double sum = 0.0;
  for (const GaussNode& node : gauss_nodes) {
    sum += node.weight * rate(from_s + node.position * (to_s - from_s));
  }
  return (to_s - from_s) * sum;
}

double FallClock::unstopped(double time_s) const {
  if (!(time_s > begin_s_)) {
    return 0.0;
  }
  const auto after = std::ranges::upper_bound(pieces_, time_s, {}, &Piece::begin_s);
  const Piece& piece = *(after - 1);
  const double run = piece.proper_time + integral(piece.begin_s, time_s);
  return after != pieces_.end() ? std::min(run, after->proper_time) : run;
}

double FallClock::proper_time(double time_s) const {
  const double run = unstopped(time_s);
  if (!stop_ || run <= *stop_ - stopping_) {
    return run;
  }
  if (run >= *stop_ + stopping_) {
    return *stop_;
  }
  // Relative to the clock without a stop, the rate falls from 1 to 0 as 1 - 3 s² + 2 s³. This
  // expression is the integral of the rate.
  const double s = (run - (*stop_ - stopping_)) / (2.0 * stopping_);
  return *stop_ - stopping_ + 2.0 * stopping_ * s * (1.0 - s * s * (1.0 - 0.5 * s));
}

std::optional<double> FallClock::time_s(double proper_time, double end_s) const {
  if (!(this->proper_time(end_s) >= proper_time)) {
    return std::nullopt;
  }
  double before = begin_s_;
  double after = end_s;
  for (int i = 0; i < 100; ++i) {
    const double middle = before + 0.5 * (after - before);
    (this->proper_time(middle) >= proper_time ? after : before) = middle;
  }
  return after;
}

void FallClock::stop_at(double proper_time) {
  constexpr double latest_s = 1e12;
  const std::optional<double> there_s = time_s(proper_time, latest_s);
  stopping_ = there_s ? std::min(0.5 * ease_s_ * rate(*there_s), proper_time) : 0.0;
  stop_ = proper_time;
}

}  // namespace ergodome
