#pragma once

#include <array>
#include <bitset>
#include <cstddef>

namespace ergodome {

//! Axes of any controller. Sticks: right and up are positive, -1 to 1. Triggers: 0 to 1. The six
//! axes of a 3D mouse: right, up, forward; nose up, nose to the right, clockwise; -1 to 1.
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

//! Buttons by position; `south` is closest to the user.
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

//! The state of a controller at one instant; initially at rest.
struct PadState {
  std::array<float, pad_axis_count> axes{};
  std::bitset<pad_button_count> buttons;

  [[nodiscard]] float axis(PadAxis which) const { return axes[static_cast<std::size_t>(which)]; }
  [[nodiscard]] bool pressed(PadButton which) const { return buttons[static_cast<std::size_t>(which)]; }

  bool operator==(const PadState&) const = default;
};

}  // namespace ergodome
