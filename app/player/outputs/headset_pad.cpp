#include "app/player/outputs/headset_pad.h"

#include <algorithm>
#include <span>

#include "app/pads/pad_response.h"

namespace ergodome {

namespace {

//! Limits from which a trigger or a grip counts as a button, as for pads.
constexpr double pulled_from = 0.5;
constexpr double let_go_below = 0.4;

bool is_pulled(double value, bool before) { return value >= (before ? let_go_below : pulled_from); }

float& axis_of(PadState& pad, PadAxis axis) { return pad.axes[static_cast<std::size_t>(axis)]; }

void set_button(PadState& pad, PadButton button, bool pressed) {
  pad.buttons.set(static_cast<std::size_t>(button), pressed);
}

//! Converts a hand's trigger, unless it moves the camera.
void take_trigger(PadState& pad, const PadState& before, const HeadsetHand& hand, PadAxis axis, PadButton button) {
  if (!hand.has_stick) {
    return;
  }
  axis_of(pad, axis) = static_cast<float>(hand.trigger);
  shape_radially(std::span(&axis_of(pad, axis), 1), PadProfile().triggers);
  set_button(pad, button, is_pulled(static_cast<double>(pad.axis(axis)), before.pressed(button)));
}

}  // namespace

PadState pad_of(const HeadsetHands& hands, const PadState& before) {
  using enum PadButton;
  const auto& [left, right] = hands;
  PadState pad;
  const double pinched = (right.has_stick ? 0.0 : right.trigger) - (left.has_stick ? 0.0 : left.trigger);
  if (left.connected && right.connected) {
    axis_of(pad, PadAxis::left_x) = static_cast<float>(left.stick_x);
    axis_of(pad, PadAxis::left_y) = static_cast<float>(std::clamp(left.stick_y + pinched, -1.0, 1.0));
    axis_of(pad, PadAxis::right_x) = static_cast<float>(right.stick_x);
    axis_of(pad, PadAxis::right_y) = static_cast<float>(right.stick_y);
  } else {
    const HeadsetHand& only = left.connected ? left : right;
    axis_of(pad, PadAxis::left_y) = static_cast<float>(std::clamp(only.stick_y + pinched, -1.0, 1.0));
    axis_of(pad, PadAxis::right_x) = static_cast<float>(only.stick_x);
  }
  const std::span<float> axes(pad.axes);
  shape_radially(axes.subspan(0, 2), PadProfile().left_stick);
  shape_radially(axes.subspan(2, 2), PadProfile().right_stick);
  take_trigger(pad, before, left, PadAxis::left_trigger, left_trigger);
  take_trigger(pad, before, right, PadAxis::right_trigger, right_trigger);
  set_button(pad, left_shoulder, is_pulled(left.grip, before.pressed(left_shoulder)));
  set_button(pad, right_shoulder, is_pulled(right.grip, before.pressed(right_shoulder)));
  set_button(pad, west, left.lower);
  set_button(pad, north, left.upper);
  set_button(pad, south, right.lower);
  set_button(pad, east, right.upper);
  set_button(pad, left_stick, left.stick);
  set_button(pad, right_stick, right.stick);
  return pad;
}

HeadsetPad::HeadsetPad() {
  PadIdentity identity;
  identity.name = "headset controllers";
  identity.connection = "OpenXR";
  identity.model = "OpenXR";
  identity_ = std::make_shared<const PadIdentity>(std::move(identity));
}

void HeadsetPad::add_to(PadSnapshot& pads, const HeadsetHands& hands) {
  const PadState before = state_;
  state_ = pad_of(hands, before);
  if (state_ != before) {
    last_input_s_ = pads.time_s;
  }
  ++frames_;
  if (!std::ranges::any_of(hands, &HeadsetHand::connected)) {
    return;
  }
  PadView view;
  view.identity = identity_;
  view.number = static_cast<int>(pads.pads.size()) + 1;
  view.connected = true;
  view.state = state_;
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    view.presses[i] = state_.buttons[i] && !before.buttons[i] ? 1 : 0;
  }
  view.last_report_s = pads.time_s;
  view.last_input_s = last_input_s_;
  view.reports = frames_;
  pads.pads.push_back(std::move(view));
}

}  // namespace ergodome
