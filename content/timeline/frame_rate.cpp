#include "content/timeline/frame_rate.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

FrameRate frame_rate_of(double frames_per_second) {
  // Accepts values such as 29.97, which film software rounds to two or three decimals.
  constexpr double short_for_hz = 0.005;
  for (const std::int64_t whole : {24, 30, 48, 60, 120}) {
    if (std::abs(frames_per_second - static_cast<double>(whole) * 1000.0 / 1001.0) < short_for_hz) {
      return {whole * 1000, 1001};
    }
  }
  const double within = std::isnan(frames_per_second) ? 30.0 : std::clamp(frames_per_second, 0.001, 1000.0);
  const double whole = std::round(within);
  if (whole == within) {
    return {static_cast<std::int64_t>(whole), 1};
  }
  return {std::llround(within * 1e6), 1'000'000};
}

double exact_rate_hz(double frames_per_second) {
  const FrameRate rate = frame_rate_of(frames_per_second);
  return rate.seconds == 1001 ? static_cast<double>(rate.frames) / 1001.0 : frames_per_second;
}

}  // namespace ergodome
