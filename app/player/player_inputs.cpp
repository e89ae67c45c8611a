#include "app/player/player_inputs.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ergodome {

namespace {

//! Threshold of an axis beyond which a visitor is considered to move it.
constexpr float deliberate = 0.15F;

bool is_for_visitors(KeyAction action) {
  const auto named = std::ranges::find(all_actions(), action, &ActionNames::action);
  return named != all_actions().end() && named->user == ActionUser::visitor && action != KeyAction::quit;
}

SteeringInput forward_and_back(const SteeringInput& input) {
  SteeringInput kept;
  kept.rates.forward = input.rates.forward;
  kept.amounts.forward = input.amounts.forward;
  return kept;
}

bool is_moved(const PadState& pad) {
  return pad.buttons.any() || std::ranges::any_of(pad.axes, [](float axis) { return std::abs(axis) > deliberate; });
}

}  // namespace

void PlayerInputs::add(const std::vector<KeyAction>& actions, PlayerInput& input) const {
  for (const KeyAction action : actions) {
    if (lock_ == InputLock::open || (lock_ == InputLock::visitors && is_for_visitors(action))) {
      input.actions.push_back(action);
    }
  }
}

void PlayerInputs::take(const WindowEvent& event, MouseState& mouse, PlayerInput& input) {
  touched_ = true;
  switch (event.kind) {
    case WindowEvent::Kind::key_down:
      press(event.key, input);
      break;
    case WindowEvent::Kind::key_up:
      held_keys_.erase(event.key);
      spent_keys_.erase(event.key);
      break;
    case WindowEvent::Kind::button_down:
      add(controls_.mouse_pressed(event.key), input);
      held_buttons_.insert(event.key);
      break;
    case WindowEvent::Kind::button_up:
      held_buttons_.erase(event.key);
      break;
    case WindowEvent::Kind::pointer:
      // Motion of the mouse only steers while a button is held, so that a bumped table has no
      // effect.
      if (!held_buttons_.empty()) {
        mouse.right_px += event.dx;
        mouse.down_px += event.dy;
      }
      break;
    case WindowEvent::Kind::scroll:
      mouse.wheel_steps += event.dy;
      add(controls_.wheel_turned(event.dy), input);
      break;
  }
  mouse.buttons.insert(held_buttons_.begin(), held_buttons_.end());
}

void PlayerInputs::press(int key, PlayerInput& input) {
  const std::vector<KeyAction> actions = controls_.pressed(key, held_keys_);
  add(actions, input);
  held_keys_.insert(key);
  if (!actions.empty()) {
    spent_keys_.insert(key);
  }
}

void PlayerInputs::take_pads(const PadSnapshot& pads, PlayerInput& input) {
  const PadState now = pads.merged();
  // A button that was pressed and released between two frames counts as pressed once.
  PadState released = now;
  PadState pressed = now;
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    if (pads.presses(static_cast<PadButton>(i)) > 0) {
      released.buttons.reset(i);
      pressed.buttons.set(i);
    } else {
      released.buttons.set(i, now.buttons.test(i));
    }
  }
  released.axes = pad_before_.axes;
  add(controls_.pressed(released, pressed), input);
  touched_ = touched_ || pressed.buttons.any() || is_moved(now);
  pad_before_ = now;
}

void PlayerInputs::find_chord(const PadState& pad) {
  const auto holds = [&](int left, int right) { return held_keys_.contains(left) || held_keys_.contains(right); };
  // This chord does not depend on the controls file, so that custom controls cannot lock an
  // operator in.
  const bool keys = held_keys_.contains(GLFW_KEY_Q) && holds(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL) &&
                    holds(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
  const bool bound = std::ranges::any_of(held_keys_, [&](int key) {
    const std::vector<KeyAction> actions = controls_.pressed(key, held_keys_);
    return std::ranges::find(actions, KeyAction::leave_exhibit) != actions.end();
  });
  const bool buttons = pad.pressed(PadButton::select) && pad.pressed(PadButton::start) &&
                       pad.pressed(PadButton::left_shoulder) && pad.pressed(PadButton::right_shoulder);
  chord_held_ = keys || bound || buttons;
}

PlayerInput PlayerInputs::gather(std::span<const WindowEvent> events, const PadSnapshot& pads, double radians_per_px) {
  touched_ = false;
  PlayerInput input;
  MouseState mouse;
  mouse.buttons = held_buttons_;
  mouse.radians_per_px = radians_per_px;
  for (const WindowEvent& event : events) {
    take(event, mouse, input);
  }
  take_pads(pads, input);
  touched_ = touched_ || !held_keys_.empty() || !held_buttons_.empty();
  find_chord(pad_before_);
  // A key pressed as Ctrl + R does not act as R when Ctrl is released first.
  std::set<int> steering_keys;
  std::ranges::set_difference(held_keys_, spent_keys_, std::inserter(steering_keys, steering_keys.end()));
  input.steering = controls_.steering(steering_keys, mouse, pad_before_);
  if (lock_ == InputLock::guide) {
    input.steering = forward_and_back(input.steering);
  }
  return input;
}

}  // namespace ergodome
