#pragma once

#include <cstdint>

namespace ergodome {

//! Frames in so many seconds: 30 in 1, 30000 in 1001.
struct FrameRate {
  std::int64_t frames = 30;
  std::int64_t seconds = 1;

  bool operator==(const FrameRate&) const = default;
};

//! The rate that a number stands for, to 1e-6 Hz; 23.976, 29.97, 47.952, 59.94 and 119.88, to 0.005 Hz, are 1000/1001 of whole ones.
FrameRate frame_rate_of(double frames_per_second);

//! The number itself, or the exact one where it is short for 1000/1001 of a whole rate [Hz].
double exact_rate_hz(double frames_per_second);

}  // namespace ergodome
