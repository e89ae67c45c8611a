#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "content/timeline/frame_rate.h"

namespace ergodome {

//! Time of a show from its start. Whole nanoseconds: as exact after 1e9 s as at the start, where a double knows 1e-7 s.
using ShowTime = std::chrono::nanoseconds;

//! Time that only goes forward, since a moment that does not matter.
using MonotonicTime = std::chrono::nanoseconds;
using TimeSource = std::function<MonotonicTime()>;

//! The machine's steady clock.
MonotonicTime steady_time();

//! Seconds to the nearest nanosecond; what is not a number is 0, and what lies beyond 4e9 s is taken as that.
ShowTime show_time(double seconds);

//! The nearest double.
double seconds_of(std::chrono::nanoseconds time);

//! The frame that is shown at a time, counted from 0.
std::int64_t frame_at(ShowTime time, FrameRate rate);

//! The first nanosecond of a frame: frame_at of it is the frame again.
ShowTime time_of_frame(std::int64_t frame, FrameRate rate);

}  // namespace ergodome
