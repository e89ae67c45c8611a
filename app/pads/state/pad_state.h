#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

//! An axis as reported by a device, with its default target.
struct RawAxis {
  //! "left_x"; for a device known only by its descriptor, the HID usage: "x", "rz", "slider".
  std::string name;
  std::int32_t minimum = 0;
  std::int32_t centre = 0;  //!< rest position; for triggers, the same as `minimum`
  std::int32_t maximum = 0;
  std::optional<PadAxis> axis;  //!< axis that it controls by default; nothing: none
  bool inverted = false;        //!< the raw value decreases as the axis increases
};

inline constexpr std::size_t max_raw_axes = 24;
inline constexpr std::size_t max_numbered_buttons = 64;

//! Axes and buttons of a device. If several raw axes control the same axis, the strongest value
//! applies.
struct RawLayout {
  std::vector<RawAxis> axes;  //!< at most `max_raw_axes`
  //! Meaning of HID buttons 1, 2, ...; empty for known devices.
  std::vector<std::optional<PadButton>> numbered;
};

//! Raw values of a device at one instant, in the order of its RawLayout.
struct RawPad {
  std::array<std::int32_t, max_raw_axes> values{};
  std::bitset<pad_button_count> buttons;
  //! HID buttons from 1, for devices known only by their descriptor.
  std::bitset<max_numbered_buttons> numbered;

  bool operator==(const RawPad&) const = default;
};

}  // namespace ergodome
