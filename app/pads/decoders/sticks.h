#pragma once

#include <cstddef>
#include <initializer_list>

#include "app/pads/decoders/report_bytes.h"

namespace ergodome {

//! Returns the raw axes of a controller with two sticks that count right and down: left x, left y,
//! right x, right y.
inline std::vector<RawAxis> stick_axes(std::int32_t least, std::int32_t centre, std::int32_t greatest) {
  return {{"left_x", least, centre, greatest, PadAxis::left_x, false},
          {"left_y", least, centre, greatest, PadAxis::left_y, true},
          {"right_x", least, centre, greatest, PadAxis::right_x, false},
          {"right_y", least, centre, greatest, PadAxis::right_y, true}};
}

//! Returns the same axes followed by two triggers, from 0 to `full`.
inline std::vector<RawAxis> stick_and_trigger_axes(std::int32_t least, std::int32_t centre, std::int32_t greatest,
                                                   std::int32_t full) {
  std::vector<RawAxis> axes = stick_axes(least, centre, greatest);
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

//! Copies 16-bit words in the same way.
inline void take_words(RawPad& pad, std::size_t first, ReportBytes report, std::size_t at, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    pad.values[first + i] = u16_at(report, at + 2 * i);
  }
}

}  // namespace ergodome
