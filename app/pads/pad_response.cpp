#include "app/pads/pad_response.h"

#include <algorithm>
#include <cmath>

#include "app/pads/state/pad_names.h"

namespace ergodome {

namespace {

constexpr double pressed_from = 0.5;
constexpr double released_below = 0.4;

//! Sets the button of a trigger if its axis is pressed far enough. A button that the device reports
//! itself stays set.
void press_trigger(PadState& state, const PadState& before, PadAxis axis, PadButton button) {
  const double threshold = before.pressed(button) ? released_below : pressed_from;
  if (state.axis(axis) >= threshold) {
    state.buttons.set(static_cast<std::size_t>(button));
  }
}

}  // namespace

double shaped(double deflection, const PadCurve& curve) {
  if (!(deflection > curve.dead_zone)) {
    return 0.0;
  }
  const double t = std::min(1.0, (deflection - curve.dead_zone) / std::max(1e-6, curve.full_at - curve.dead_zone));
  const double s = std::pow(t, curve.exponent);
  return (1.0 - curve.expo) * s + curve.expo * s * s * s;
}

void shape_radially(std::span<float> vector, const PadCurve& curve) {
  double square = 0.0;
  for (const float component : vector) {
    square += static_cast<double>(component) * component;
  }
  const double length = std::sqrt(square);
  const double scale = length > 0.0 ? shaped(length, curve) / length : 0.0;
  for (float& component : vector) {
    component = static_cast<float>(component * scale);
  }
}

PadResponse::PadResponse(const RawLayout& layout, const PadProfile& profile)
    : numbered_(profile.buttons.empty() ? layout.numbered : profile.buttons),
      inverted_(profile.inverted),
      left_stick_(profile.left_stick),
      right_stick_(profile.right_stick),
      triggers_(profile.triggers),
      puck_(profile.puck) {
  for (const RawAxis& raw : layout.axes) {
    const auto target = profile.axes.find(raw.name);
    const bool remapped = target != profile.axes.end();
    const std::optional<PadAxis> axis = remapped ? target->second.axis : raw.axis;
    const auto measured = profile.calibration.find(raw.name);
    const AxisCalibration range = measured != profile.calibration.end()
                                      ? measured->second
                                      : AxisCalibration{raw.minimum, raw.centre, raw.maximum};
    axes_.push_back({.axis = axis.value_or(PadAxis::left_x),
                     .moves = axis.has_value(),
                     .inverted = remapped ? target->second.inverted : raw.inverted,
                     .minimum = static_cast<double>(range.minimum),
                     .centre = static_cast<double>(range.centre),
                     .maximum = static_cast<double>(range.maximum)});
  }
}

double PadResponse::position(std::size_t raw_axis, std::int32_t value) const {
  if (raw_axis >= axes_.size() || !axes_[raw_axis].moves) {
    return 0.0;
  }
  const Mapped& mapped = axes_[raw_axis];
  if (is_trigger(mapped.axis)) {
    const double part = (value - mapped.minimum) / std::max(1.0, mapped.maximum - mapped.minimum);
    const double inside = std::clamp(part, 0.0, 1.0);
    return mapped.inverted ? 1.0 - inside : inside;
  }
  const double from_centre = value - mapped.centre;
  const double whole = from_centre > 0.0 ? mapped.maximum - mapped.centre : mapped.centre - mapped.minimum;
  const double inside = std::clamp(from_centre / std::max(1.0, whole), -1.0, 1.0);
  return mapped.inverted ? -inside : inside;
}

PadState PadResponse::apply(const RawPad& raw, const std::bitset<max_raw_axes>& ignored, const PadState& before) const {
  PadState state;
  for (std::size_t i = 0; i < axes_.size() && i < max_raw_axes; ++i) {
    float& axis = state.axes[static_cast<std::size_t>(axes_[i].axis)];
    const auto here = static_cast<float>(ignored[i] ? 0.0 : position(i, raw.values[i]));
    if (std::abs(here) > std::abs(axis)) {
      axis = here;
    }
  }
  for (std::size_t i = 0; i < pad_axis_count; ++i) {
    if (inverted_[i]) {
      state.axes[i] = is_trigger(static_cast<PadAxis>(i)) ? 1.0F - state.axes[i] : -state.axes[i];
    }
  }
  const std::span<float> axes(state.axes);
  shape_radially(axes.subspan(0, 2), left_stick_);
  shape_radially(axes.subspan(2, 2), right_stick_);
  shape_radially(axes.subspan(4, 1), triggers_);
  shape_radially(axes.subspan(5, 1), triggers_);
  shape_radially(axes.subspan(6, 3), puck_);
  shape_radially(axes.subspan(9, 3), puck_);

  state.buttons = raw.buttons;
  for (std::size_t i = 0; i < numbered_.size() && i < max_numbered_buttons; ++i) {
    if (raw.numbered[i] && numbered_[i]) {
      state.buttons.set(static_cast<std::size_t>(*numbered_[i]));
    }
  }
  press_trigger(state, before, PadAxis::left_trigger, PadButton::left_trigger);
  press_trigger(state, before, PadAxis::right_trigger, PadButton::right_trigger);
  return state;
}

}  // namespace ergodome
