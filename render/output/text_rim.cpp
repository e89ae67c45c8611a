#include "render/output/text_rim.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ergodome {

namespace {

//! Reach of the rim as a fraction of the line height, its darkness, and the gain of its edge.
constexpr double rim_reach = 0.22;
constexpr float rim_darkness = 0.97F;
constexpr float rim_gain = 5.0F;

//! Averages over 2 reach + 1 neighbors along lines. Lines start `line` elements apart, and their
//! elements are `step` apart.
void blur_lines(std::vector<float>& values, int lines, long line, int count, long step, int reach) {
  std::vector<float> before(static_cast<std::size_t>(count));
  for (int i = 0; i < lines; ++i) {
    float* first = values.data() + i * line;
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
      before[static_cast<std::size_t>(k)] = first[k * step];
    }
    for (int k = 0; k < std::min(reach, count); ++k) {
      sum += static_cast<double>(before[static_cast<std::size_t>(k)]);
    }
    for (int k = 0; k < count; ++k) {
      const int entering = k + reach;
      const int leaving = k - reach - 1;
      sum += entering < count ? static_cast<double>(before[static_cast<std::size_t>(entering)]) : 0.0;
      sum -= leaving >= 0 ? static_cast<double>(before[static_cast<std::size_t>(leaving)]) : 0.0;
      first[k * step] = static_cast<float>(std::max(sum, 0.0) / (2 * reach + 1));
    }
  }
}

}  // namespace

int text_rim_reach_px(int line_px) { return std::max(static_cast<int>(std::lround(rim_reach * line_px)), 2); }

std::vector<float> text_rim(const std::vector<float>& coverage, int width, int height, int reach_px) {
  std::vector<float> rim = coverage;
  // Two box blurs each way are almost as smooth as a Gaussian, but have finite reach.
  const int half_px = std::max(reach_px / 2, 1);
  for (int round = 0; round < 2; ++round) {
    blur_lines(rim, height, width, width, 1, half_px);
    blur_lines(rim, width, 1, height, width, half_px);
  }
  for (float& value : rim) {
    value = rim_darkness * std::min(rim_gain * value, 1.0F);
  }
  return rim;
}

}  // namespace ergodome
