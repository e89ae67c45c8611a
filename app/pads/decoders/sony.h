#pragma once

#include "app/pads/decoders/report_bytes.h"

namespace ergodome {

//! Returns whether the last four bytes of a Bluetooth report are the CRC-32 of 0xA1 (the transport
//! header) and all bytes before them.
inline bool sony_checksum_holds(ReportBytes report) {
  const std::size_t end = report.size() - 4;
  const auto told =
      static_cast<std::uint32_t>(u16_at(report, end)) | (static_cast<std::uint32_t>(u16_at(report, end + 2)) << 16U);
  return crc32_after(0xA1, report.first(end)) == told;
}

//! Reads the hat from the low nibble and the four face buttons from the high one.
inline void press_sony_face(RawPad& pad, std::uint8_t byte) {
  press_hat(pad, byte & 0x0F);
  press_bits(pad, byte,
             {{0x10, PadButton::west}, {0x20, PadButton::south}, {0x40, PadButton::east}, {0x80, PadButton::north}});
}

inline void press_sony_shoulders(RawPad& pad, std::uint8_t byte) {
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

//! Sets the axis of a pressed trigger to full if it is 0: some controllers have switches as
//! triggers.
inline void pull_pressed_triggers(RawPad& pad, std::uint8_t shoulders, std::size_t left, std::size_t right) {
  if ((shoulders & 0x04) != 0 && pad.values[left] == 0) {
    pad.values[left] = 255;
  }
  if ((shoulders & 0x08) != 0 && pad.values[right] == 0) {
    pad.values[right] = 255;
  }
}

}  // namespace ergodome
