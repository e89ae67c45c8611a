#include "render/present/headset/comfort.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

// Speeds at which the vignette begins and is complete [1/s]. The faster one is just below the
// default of FlightSettings::max_speed; going around the hole with it turns the surroundings by
// about 30° per second.
constexpr double slow_speed = 0.02;
constexpr double fast_speed = 0.5;

constexpr double vignette_rise_s = 0.15;
constexpr double vignette_fall_s = 0.5;
constexpr double widest_clear_rad = 60.0 * one_degree;
constexpr double narrowest_clear_rad = 35.0 * one_degree;

//! Rate of the fastest smooth turn [rad/s].
constexpr double smooth_turn_rate = 45.0 * one_degree;

//! The view stays black around a snap turn for longer than a frame at 30 Hz, so that the division
//! into frames does not change the fade.
constexpr double longest_dark_s = 0.04;

//! Maximum number of snap turns that one frame may request.
constexpr double max_snap_turns = 12.0;

//! Clamps a number to a range; NaN counts as 0.
double number_within(double value, double minimum, double maximum) {
  return std::clamp(std::isnan(value) ? 0.0 : value, minimum, maximum);
}

//! Moves `value` toward `target` by at most `change`.
double stepped(double value, double target, double change) {
  return value < target ? std::min(value + change, target) : std::max(value - change, target);
}

}  // namespace

double clear_half_angle_rad(double vignette) {
  return widest_clear_rad + number_within(vignette, 0.0, 1.0) * (narrowest_clear_rad - widest_clear_rad);
}

HeadsetComfort::HeadsetComfort(const HeadsetSettings& settings) { change(settings); }

void HeadsetComfort::change(const HeadsetSettings& settings) {
  settings_ = settings;
  settings_.vignette = number_within(settings.vignette, 0.0, 1.0);
  settings_.fade_s = number_within(settings.fade_s, 0.0, 5.0);
  settings_.snap_turn_deg = number_within(settings.snap_turn_deg, 0.0, 90.0);
  settings_.exposure_rate = number_within(settings.exposure_rate, 0.0, 1e3);
}

ComfortState HeadsetComfort::advance(double seconds, const ComfortInput& input) {
  // An hour is longer than any change takes, and keeps products of rates and times finite.
  const double passed_s = number_within(seconds, 0.0, 3600.0);
  advance_vignette(passed_s, number_within(input.speed, 0.0, 1e3), number_within(input.smooth_turn, -1.0, 1.0));
  advance_fade(passed_s);
  const double stops = number_within(input.exposure_stops, -max_comfort_stops, max_comfort_stops);
  advance_exposure(passed_s, stops);
  if (input.cut || !started_) {
    exposure_stops_ = stops;
  }
  if (input.cut && settings_.fade_s > 0.0) {
    light_ = 0.0;
    dark_left_s_ = 0.0;
    fade_in_s_ = settings_.fade_s;
  }
  requested_rad_ += one_degree * settings_.snap_turn_deg *
                    std::round(number_within(input.snap_turn, -max_snap_turns, max_snap_turns));
  if (light_ <= 0.0 || settings_.fade_s <= 0.0) {
    turn_as_requested();
  }
  started_ = true;
  return {vignette_, clear_half_angle_rad(vignette_), light_, yaw_rad_, exposure_stops_};
}

double HeadsetComfort::dark_s() const { return std::min(longest_dark_s, 0.5 * settings_.fade_s); }

double HeadsetComfort::snap_fade_s() const { return 0.5 * (settings_.fade_s - dark_s()); }

void HeadsetComfort::advance_vignette(double seconds, double speed, double smooth_turn) {
  double motion = std::clamp((speed - slow_speed) / (fast_speed - slow_speed), 0.0, 1.0);
  if (settings_.snap_turn_deg <= 0.0) {
    turn(smooth_turn * smooth_turn_rate * seconds);
    motion = std::max(motion, std::abs(smooth_turn));
  }
  const double target = settings_.vignette * motion;
  vignette_ = stepped(vignette_, target, seconds / (target > vignette_ ? vignette_rise_s : vignette_fall_s));
}

void HeadsetComfort::advance_fade(double seconds) {
  if (settings_.fade_s <= 0.0) {
    light_ = 1.0;
    dark_left_s_ = 0.0;
    return;
  }
  double left_s = seconds;
  if (requested_rad_ != 0.0) {
    fade_in_s_ = snap_fade_s();
    const double fade_out_s = light_ * snap_fade_s();
    if (left_s < fade_out_s) {
      light_ -= left_s / snap_fade_s();
      return;
    }
    left_s -= fade_out_s;
    light_ = 0.0;
    turn_as_requested();
    // The view turns in a black frame, even if this frame is later than the end of the dark.
    dark_left_s_ = std::max(dark_s() - left_s, 0.0);
    return;
  }
  const double still_dark_s = std::min(left_s, dark_left_s_);
  dark_left_s_ -= still_dark_s;
  left_s -= still_dark_s;
  light_ = fade_in_s_ > 0.0 ? std::min(light_ + left_s / fade_in_s_, 1.0) : 1.0;
}

void HeadsetComfort::advance_exposure(double seconds, double stops) {
  const bool limited = settings_.exposure_rate > 0.0;
  exposure_stops_ = limited ? stepped(exposure_stops_, stops, settings_.exposure_rate * seconds) : stops;
}

void HeadsetComfort::turn(double angle_rad) { yaw_rad_ = std::remainder(yaw_rad_ + angle_rad, full_turn); }

void HeadsetComfort::turn_as_requested() {
  turn(requested_rad_);
  requested_rad_ = 0.0;
}

}  // namespace ergodome
