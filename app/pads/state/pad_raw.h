#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/pads/state/pad_state.h"

namespace ergodome {

//! An axis as reported by a device, with its default target.
struct RawAxis {
  //! "left_x"; for a device known only by its descriptor, the HID usage: "x", "rz", "slider".
  std::string name;
  std::int32_t least = 0;
  std::int32_t centre = 0;  //!< rest position of a stick; unused for triggers
  std::int32_t greatest = 0;
  std::optional<PadAxis> axis;  //!< nothing: controls nothing by default
  bool inverted = false;        //!< the raw value decreases as the axis increases
};

inline constexpr std::size_t most_raw_axes = 24;
inline constexpr std::size_t most_numbered_buttons = 64;

//! Axes and buttons of a device. If several raw axes control the same axis, the strongest value
//! applies.
struct RawLayout {
  std::vector<RawAxis> axes;  //!< at most `most_raw_axes`
  //! Meaning of HID buttons 1, 2, ...; empty for known devices.
  std::vector<std::optional<PadButton>> numbered;
};

//! Raw values of a device at one instant, in the order of its RawLayout.
struct RawPad {
  std::array<std::int32_t, most_raw_axes> values{};
  std::bitset<pad_button_count> buttons;
  //! HID buttons from 1, for devices known only by their descriptor.
  std::bitset<most_numbered_buttons> numbered;

  bool operator==(const RawPad&) const = default;
};

}  // namespace ergodome
