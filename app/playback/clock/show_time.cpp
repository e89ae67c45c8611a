#include "app/playback/clock/show_time.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t nanoseconds_a_second = 1'000'000'000;

Wide floor_quotient(Wide a, Wide b) { return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0); }

}  // namespace

MonotonicTime steady_time() {
  return std::chrono::duration_cast<MonotonicTime>(std::chrono::steady_clock::now().time_since_epoch());
}

ShowTime show_time(double seconds) {
  if (std::isnan(seconds)) {
    return {};
  }
  const double within = std::clamp(seconds, -4e9, 4e9);
  const double whole = std::trunc(within);
  return std::chrono::seconds(static_cast<std::int64_t>(whole)) + ShowTime(std::llround((within - whole) * 1e9));
}

double seconds_of(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) / 1e9; }

std::int64_t frame_at(ShowTime time, FrameRate rate) {
  return static_cast<std::int64_t>(
      floor_quotient(Wide{time.count()} * rate.frames, Wide{rate.seconds} * nanoseconds_a_second));
}

ShowTime time_of_frame(std::int64_t frame, FrameRate rate) {
  const Wide ticks = Wide{frame} * rate.seconds * nanoseconds_a_second;
  return ShowTime(static_cast<std::int64_t>(-floor_quotient(-ticks, rate.frames)));
}

}  // namespace ergodome
