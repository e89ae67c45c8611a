#pragma once

#include <array>
#include <bitset>
#include <cstddef>

namespace ergodome {

//! What a person moves on any controller. Sticks: right and up are positive, -1 to 1. Triggers: 0 to 1. The six of a puck that is pushed
//! and turned: right, up, forward; nose up, nose to the right, clockwise; -1 to 1.
enum class PadAxis {
  left_x,
  left_y,
  right_x,
  right_y,
  left_trigger,
  right_trigger,
  move_right,
  move_up,
  move_forward,
  turn_pitch,
  turn_yaw,
  turn_roll
};
inline constexpr std::size_t pad_axis_count = 12;

//! Buttons by where they are; `south` is the one nearest to the person.
enum class PadButton {
  south,
  east,
  west,
  north,
  left_shoulder,
  right_shoulder,
  left_trigger,
  right_trigger,
  select,
  start,
  guide,
  left_stick,
  right_stick,
  dpad_up,
  dpad_down,
  dpad_left,
  dpad_right,
  capture,
  touch,
  paddle_1,
  paddle_2,
  paddle_3,
  paddle_4
};
inline constexpr std::size_t pad_button_count = 23;

//! A controller at one instant; at rest where nothing is known.
struct PadState {
  std::array<float, pad_axis_count> axes{};
  std::bitset<pad_button_count> buttons;

  [[nodiscard]] float axis(PadAxis which) const { return axes[static_cast<std::size_t>(which)]; }
  [[nodiscard]] bool pressed(PadButton which) const { return buttons[static_cast<std::size_t>(which)]; }

  bool operator==(const PadState&) const = default;
};

}  // namespace ergodome
