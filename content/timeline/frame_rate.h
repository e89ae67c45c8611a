#pragma once

#include <cstdint>

namespace ergodome {

//! A frame rate as a fraction: 30 frames in 1 second, 30000 in 1001.
struct FrameRate {
  std::int64_t frames = 30;
  std::int64_t seconds = 1;

  bool operator==(const FrameRate&) const = default;
};

//! Returns the rate that a number stands for, to 1e-6 Hz, clamped to 0.001 to 1000 Hz; 30 Hz for
//! NaN. Numbers within 0.005 Hz of 23.976, 29.97, 47.952, 59.94 and 119.88 become 1000/1001 of a
//! whole rate.
FrameRate frame_rate_of(double frames_per_second);

//! Returns the exact rate if the number abbreviates 1000/1001 of a whole rate, else the number
//! [Hz].
double exact_rate_hz(double frames_per_second);

}  // namespace ergodome
