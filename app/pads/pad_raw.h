#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/pads/pad_state.h"

namespace ergodome {

//! One axis as a device counts it, and what it moves by default.
struct RawAxis {
  std::string name;  //!< "left_x"; of a device known by its descriptor alone, the HID usage: "x", "rz", "slider"
  std::int32_t least = 0;
  std::int32_t centre = 0;  //!< where a stick rests; unused by triggers
  std::int32_t greatest = 0;
  std::optional<PadAxis> axis;  //!< nothing: read, but moves nothing unless the settings say so
  bool inverted = false;        //!< counts down where the axis counts up
};

inline constexpr std::size_t most_raw_axes = 24;
inline constexpr std::size_t most_numbered_buttons = 64;

//! What a device has. Several raw axes may move the same axis: the strongest one does.
struct RawLayout {
  std::vector<RawAxis> axes;                       //!< at most `most_raw_axes`
  std::vector<std::optional<PadButton>> numbered;  //!< what HID button 1, 2, ... is; empty where the device is known
};

//! A device's own numbers at one instant, in the order of its RawLayout.
struct RawPad {
  std::array<std::int32_t, most_raw_axes> values{};
  std::bitset<pad_button_count> buttons;
  std::bitset<most_numbered_buttons> numbered;  //!< HID buttons from 1, of devices known by their descriptor alone

  bool operator==(const RawPad&) const = default;
};

}  // namespace ergodome
