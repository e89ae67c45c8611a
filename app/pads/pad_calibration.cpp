#include "app/pads/pad_calibration.h"

#include <algorithm>
#include <cmath>

#include "app/pads/state/pad_names.h"

namespace ergodome {

namespace {

//! Minimum deviation of an axis from where it rested, as a fraction of its range, that counts as
//! motion; smaller deviations are noise.
constexpr double motion = 0.04;
constexpr double min_travel = 0.5;

}  // namespace

void PadCalibrator::Range::take(std::int32_t value) {
  minimum = std::min(minimum, value);
  maximum = std::max(maximum, value);
}

PadCalibrator::PadCalibrator(RawLayout layout, double rest_s) : layout_(std::move(layout)), rest_s_(rest_s) {}

double PadCalibrator::nominal(std::size_t axis) const {
  return std::max(1.0, static_cast<double>(layout_.axes[axis].maximum) - layout_.axes[axis].minimum);
}

void PadCalibrator::take(const RawPad& pad, double now_s) {
  bool moves = false;
  for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
    const std::int32_t value = pad.values[i];
    if (!begun_) {
      all_[i] = rest_[i] = first_rest_[i] = {value, value};
    }
    moves = moves || std::abs(value - rest_[i].middle()) > motion * nominal(i);
  }
  if (!begun_ || moves) {
    resting_since_s_ = now_s;
  }
  first_rest_over_ = first_rest_over_ || moves;
  begun_ = true;
  for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
    const std::int32_t value = pad.values[i];
    all_[i].take(value);
    if (moves) {
      rest_[i] = {value, value};
    }
    rest_[i].take(value);
    if (!first_rest_over_) {
      first_rest_[i].take(value);
    }
  }
}

bool PadCalibrator::is_moved(std::size_t axis) const {
  return static_cast<double>(all_[axis].maximum) - all_[axis].minimum >= min_travel * nominal(axis);
}

bool PadCalibrator::is_done(double now_s) const {
  if (!first_rest_over_ || now_s - resting_since_s_ < rest_s_) {
    return false;
  }
  for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
    if (is_moved(i)) {
      return true;
    }
  }
  return false;
}

std::vector<std::string> PadCalibrator::unmoved() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
    if (!is_moved(i)) {
      names.push_back(layout_.axes[i].name);
    }
  }
  return names;
}

//! Returns the largest deviation of an axis at rest from its center, as a fraction of half its
//! range.
double PadCalibrator::wander(std::size_t axis) const {
  const double middle = rest_[axis].middle();
  const double farthest =
      std::max(std::abs(first_rest_[axis].minimum - middle),
               std::max(std::abs(first_rest_[axis].maximum - middle), rest_[axis].maximum - middle));
  return farthest / (0.5 * std::max(1.0, static_cast<double>(all_[axis].maximum) - all_[axis].minimum));
}

void PadCalibrator::set_dead_zone(PadCurve& curve, PadAxis x, PadAxis y) const {
  double square = 0.0;
  bool any = false;
  for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
    if ((layout_.axes[i].axis == x || layout_.axes[i].axis == y) && is_moved(i)) {
      square += wander(i) * wander(i);
      any = true;
    }
  }
  if (any) {
    // Springs do not return a stick to exactly the same position, so a margin is added.
    const double dead_zone = std::clamp(0.05 + 1.5 * std::sqrt(square), 0.05, 0.4);
    curve.dead_zone = std::round(dead_zone * 1000.0) / 1000.0;
    curve.full_at = std::max(curve.full_at, curve.dead_zone + 0.1);
  }
}

PadProfile PadCalibrator::applied_to(PadProfile profile) const {
  for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
    if (!is_moved(i)) {
      continue;
    }
    const auto middle = static_cast<std::int32_t>(std::lround(rest_[i].middle()));
    const RawAxis& axis = layout_.axes[i];
    profile.calibration[axis.name] = axis.axis && is_trigger(*axis.axis)
                                         ? AxisCalibration{middle, middle, std::max(middle + 1, all_[i].maximum)}
                                         : AxisCalibration{all_[i].minimum, middle, all_[i].maximum};
  }
  set_dead_zone(profile.left_stick, PadAxis::left_x, PadAxis::left_y);
  set_dead_zone(profile.right_stick, PadAxis::right_x, PadAxis::right_y);
  return profile;
}

}  // namespace ergodome
