#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "content/timeline/frame_rate.h"

namespace ergodome {

//! Show time in integer nanoseconds: as exact after 1e9 s, where a double has a resolution of 1e-7
//! s, as at the start.
using ShowTime = std::chrono::nanoseconds;

//! Monotonic time from an arbitrary origin.
using MonotonicTime = std::chrono::nanoseconds;
using TimeSource = std::function<MonotonicTime()>;

//! Returns the time of the machine's steady clock.
MonotonicTime steady_time();

//! Rounds seconds to the nearest nanosecond. NaN becomes 0; values are clamped to 4e9 s.
ShowTime show_time(double seconds);

//! Converts to the nearest double.
double seconds_of(std::chrono::nanoseconds time);

//! Returns the frame shown at a time, counted from 0.
std::int64_t frame_at(ShowTime time, FrameRate rate);

//! Returns the first nanosecond of a frame; frame_at() of it is that frame.
ShowTime time_of_frame(std::int64_t frame, FrameRate rate);

}  // namespace ergodome
