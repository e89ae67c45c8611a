#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "app/pads/state/pad_state.h"

namespace ergodome {

// Helpers with which decoders read the bytes of reports.
using ReportBytes = std::span<const std::uint8_t>;

//! u16_at() and i16_at() read 16 bits at byte `at`, low byte first, without or with sign. The
//! caller checks the size.
inline std::uint16_t u16_at(ReportBytes report, std::size_t at) {
  return static_cast<std::uint16_t>(report[at] | (report[at + 1] << 8U));
}

inline std::int16_t i16_at(ReportBytes report, std::size_t at) { return static_cast<std::int16_t>(u16_at(report, at)); }

//! A bit of a byte, with its button.
struct ButtonBit {
  std::uint8_t mask;
  PadButton button;
};

inline void press(RawPad& pad, PadButton button) { pad.buttons.set(static_cast<std::size_t>(button)); }

//! Presses the buttons whose bits are set.
inline void press_bits(RawPad& pad, std::uint8_t byte, std::initializer_list<ButtonBit> bits) {
  for (const ButtonBit& bit : bits) {
    if ((byte & bit.mask) != 0) {
      press(pad, bit.button);
    }
  }
}

//! Presses the directional buttons of a hat: eight directions, clockwise from 0, which is up. Other
//! values press none.
inline void press_hat(RawPad& pad, int direction) {
  if (direction < 0 || direction > 7) {
    return;
  }
  if (direction == 7 || direction <= 1) {
    press(pad, PadButton::dpad_up);
  }
  if (direction >= 1 && direction <= 3) {
    press(pad, PadButton::dpad_right);
  }
  if (direction >= 3 && direction <= 5) {
    press(pad, PadButton::dpad_down);
  }
  if (direction >= 5) {
    press(pad, PadButton::dpad_left);
  }
}

//! Presses the hat's direction in the low nibble and the face buttons in the high one, in the order
//! of Sony's controllers and those that follow them.
inline void press_hat_and_face(RawPad& pad, std::uint8_t byte) {
  press_hat(pad, byte & 0x0F);
  press_bits(pad, byte,
             {{0x10, PadButton::west}, {0x20, PadButton::south}, {0x40, PadButton::east}, {0x80, PadButton::north}});
}

//! Presses the buttons of the byte that follows that of press_hat_and_face() in reports: shoulders,
//! triggers, select, start, and sticks.
inline void press_shoulders(RawPad& pad, std::uint8_t byte) {
  press_bits(pad, byte,
             {{0x01, PadButton::left_shoulder},
              {0x02, PadButton::right_shoulder},
              {0x04, PadButton::left_trigger},
              {0x08, PadButton::right_trigger},
              {0x10, PadButton::select},
              {0x20, PadButton::start},
              {0x40, PadButton::left_stick},
              {0x80, PadButton::right_stick}});
}

//! Presses the first eight buttons in the order of Android's gamepads: A, B, C, X, Y, Z, and the
//! shoulders. C and Z are left out.
inline void press_android_face(RawPad& pad, std::uint8_t byte) {
  press_bits(pad, byte,
             {{0x01, PadButton::south},
              {0x02, PadButton::east},
              {0x08, PadButton::west},
              {0x10, PadButton::north},
              {0x40, PadButton::left_shoulder},
              {0x80, PadButton::right_shoulder}});
}

//! Presses select, start, guide and the buttons of the sticks, from the byte that follows that of
//! press_android_face(). Ignores the triggers in its lowest two bits.
inline void press_android_middle(RawPad& pad, std::uint8_t byte) {
  press_bits(pad, byte,
             {{0x04, PadButton::select},
              {0x08, PadButton::start},
              {0x10, PadButton::guide},
              {0x20, PadButton::left_stick},
              {0x40, PadButton::right_stick}});
}

//! Computes the CRC-32 (IEEE 802.3, as in zlib) of the byte `seed` followed by bytes.
std::uint32_t crc32_after(std::uint8_t seed, ReportBytes bytes);

//! Returns the raw axes of a controller with two sticks that count right and down: left x, left y,
//! right x, right y.
inline std::vector<RawAxis> stick_axes(std::int32_t minimum, std::int32_t centre, std::int32_t maximum) {
  return {{"left_x", minimum, centre, maximum, PadAxis::left_x, false},
          {"left_y", minimum, centre, maximum, PadAxis::left_y, true},
          {"right_x", minimum, centre, maximum, PadAxis::right_x, false},
          {"right_y", minimum, centre, maximum, PadAxis::right_y, true}};
}

//! Returns the axes of stick_axes(), followed by two triggers, from 0 to `full`.
inline std::vector<RawAxis> stick_and_trigger_axes(std::int32_t minimum, std::int32_t centre, std::int32_t maximum,
                                                   std::int32_t full) {
  std::vector<RawAxis> axes = stick_axes(minimum, centre, maximum);
  axes.push_back({"left_trigger", 0, 0, full, PadAxis::left_trigger, false});
  axes.push_back({"right_trigger", 0, 0, full, PadAxis::right_trigger, false});
  return axes;
}

//! Copies `count` bytes of a report from `at` on to the raw axes from `first` on.
inline void take_bytes(RawPad& pad, std::size_t first, ReportBytes report, std::size_t at, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    pad.values[first + i] = report[at + i];
  }
}

//! Copies `count` 16-bit words of a report to raw axes, like take_bytes().
inline void take_words(RawPad& pad, std::size_t first, ReportBytes report, std::size_t at, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    pad.values[first + i] = u16_at(report, at + 2 * i);
  }
}

}  // namespace ergodome
