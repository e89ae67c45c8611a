#include "app/navigation/controls/controls.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/controls/steer_binding.h"

namespace ergodome {

namespace {

const std::vector<Input> nothing;

unsigned modifiers_of(const std::set<int>& held_keys) {
  unsigned held = 0;
  for (const int key : held_keys) {
    held |= modifier_of(key);
  }
  return held;
}

//! Returns whether a steering key is held together with exactly the modifiers of its binding. Shift
//! may be held in addition, because it requests speed.
bool steers(const Input& input, const std::set<int>& held_keys, unsigned modifiers) {
  if (!held_keys.contains(input.code)) {
    return false;
  }
  const unsigned own = modifier_of(input.code);
  const unsigned others = modifiers & ~own;
  return (others | shift_held) == (input.modifiers | shift_held) && (input.modifiers & ~others) == 0;
}

//! Returns the rate at which an input steers, from -1 to 1: 1 while a key or button is held, or the
//! value of a controller's axis. Motions of the mouse and its wheel have no rate: 0.
double rate_of(const Input& input, const std::set<int>& held_keys, unsigned modifiers, const MouseState& mouse,
               const PadState& pad) {
  switch (input.kind) {
    case Input::Kind::key:
      return steers(input, held_keys, modifiers) ? 1.0 : 0.0;
    case Input::Kind::mouse_button:
      return mouse.buttons.contains(input.code) ? 1.0 : 0.0;
    case Input::Kind::pad_button:
      return pad.pressed(static_cast<PadButton>(input.code)) ? 1.0 : 0.0;
    case Input::Kind::pad_axis:
      return static_cast<double>(pad.axis(static_cast<PadAxis>(input.code)));
    default:
      return 0.0;
  }
}

//! Returns the motion of the mouse along an axis as an angle [rad], or of its wheel in steps; 0 for
//! other inputs.
double amount_of(const Input& input, const MouseState& mouse) {
  switch (input.kind) {
    case Input::Kind::mouse_axis:
      return (input.code == 0 ? mouse.right_px : mouse.down_px) * mouse.radians_per_px;
    case Input::Kind::wheel:
      return mouse.wheel_steps;
    default:
      return 0.0;
  }
}

}  // namespace

Controls::Controls() {
  for (const ActionNames& named : all_actions()) {
    for (const std::string& name : words_of(named.inputs)) {
      actions_[named.action].push_back(*input_of(name));
    }
  }
  for (const SteerNames& named : all_steering()) {
    std::vector<SteerBinding>& bindings = steering_.emplace_back();
    for (const std::string& text : words_of(named.inputs)) {
      bindings.push_back(*steer_binding_of(text));
    }
  }
}

SteeringInput Controls::steering(const std::set<int>& held_keys, const MouseState& mouse, const PadState& pad) const {
  const unsigned modifiers = modifiers_of(held_keys);
  SteeringInput input;
  for (std::size_t i = 0; i < steering_.size(); ++i) {
    double Steering::*const component = all_steering()[i].component;
    double rate = 0.0;
    for (const SteerBinding& binding : steering_[i]) {
      rate += binding.scale * rate_of(binding.input, held_keys, modifiers, mouse, pad);
      input.amounts.*component += binding.scale * amount_of(binding.input, mouse);
    }
    input.rates.*component = std::clamp(rate, -1.0, 1.0);
  }
  input.rates.faster = std::max(input.rates.faster, 0.0);
  return input;
}

KeyAction Controls::action_for(const Input& input) const {
  for (const auto& [action, inputs] : actions_) {
    if (std::ranges::find(inputs, input) != inputs.end()) {
      return action;
    }
  }
  return KeyAction::none;
}

std::vector<KeyAction> Controls::pressed(int key, const std::set<int>& held_keys) const {
  const KeyAction action = action_for({Input::Kind::key, key, modifiers_of(held_keys) & ~modifier_of(key)});
  return action == KeyAction::none ? std::vector<KeyAction>{} : std::vector{action};
}

std::vector<KeyAction> Controls::pressed(const PadState& before, const PadState& now) const {
  std::vector<KeyAction> actions;
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    const KeyAction action = now.buttons[i] && !before.buttons[i]
                                 ? action_for({Input::Kind::pad_button, static_cast<int>(i), 0})
                                 : KeyAction::none;
    if (action != KeyAction::none) {
      actions.push_back(action);
    }
  }
  return actions;
}

std::vector<KeyAction> Controls::mouse_pressed(int button) const {
  const KeyAction action = action_for({Input::Kind::mouse_button, button, 0});
  return action == KeyAction::none ? std::vector<KeyAction>{} : std::vector{action};
}

std::vector<KeyAction> Controls::wheel_turned(double steps) const {
  const KeyAction action = action_for({Input::Kind::wheel_step, steps > 0.0 ? 1 : -1, 0});
  constexpr double maximum = 20.0;
  const double times = std::isfinite(steps) ? std::clamp(std::abs(steps), 0.0, maximum) : 0.0;
  return action == KeyAction::none ? std::vector<KeyAction>{}
                                   : std::vector<KeyAction>(static_cast<std::size_t>(times), action);
}

const std::vector<Input>& Controls::inputs_of(KeyAction action) const {
  const auto found = actions_.find(action);
  return found == actions_.end() ? nothing : found->second;
}

const std::vector<Controls::SteerBinding>& Controls::inputs_of(double Steering::*component) const {
  const auto named = all_steering();
  const auto found = std::ranges::find(named, component, &SteerNames::component);
  return steering_[static_cast<std::size_t>(found - named.begin())];
}

}  // namespace ergodome
