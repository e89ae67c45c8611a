#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "app/pads/pad_raw.h"

namespace ergodome {

using ReportBytes = std::span<const std::uint8_t>;

//! 16 bits, the low byte first. The caller has checked that they are there.
inline std::uint16_t u16_at(ReportBytes report, std::size_t at) {
  return static_cast<std::uint16_t>(report[at] | (report[at + 1] << 8U));
}

inline std::int16_t i16_at(ReportBytes report, std::size_t at) { return static_cast<std::int16_t>(u16_at(report, at)); }

//! A bit of a byte, and the button that it is.
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

//! A hat's eight directions, clockwise from 0, up; anything else is none.
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

//! CRC-32 (IEEE 802.3, as of zlib) of bytes, after the one byte `seed` before them.
std::uint32_t crc32_after(std::uint8_t seed, ReportBytes bytes);

}  // namespace ergodome
