#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "app/pads/state/pad_raw.h"

namespace ergodome {

// Helpers with which decoders read the bytes of reports.
using ReportBytes = std::span<const std::uint8_t>;

//! Read 16 bits, low byte first. The caller checks the size.
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

//! Computes the CRC-32 (IEEE 802.3, as in zlib) of the byte `seed` followed by bytes.
std::uint32_t crc32_after(std::uint8_t seed, ReportBytes bytes);

}  // namespace ergodome
