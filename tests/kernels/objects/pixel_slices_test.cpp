#include "kernels/objects/pixel_slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

// Tests of the slices of a pixel: strips along the edge of the shadow.
namespace ergodome {
namespace {

//! A pixel, and an edge through it or near it. The edge is given by its position angle and by its
//! distance from the center of the pixel.
class PixelSlicesAt : public testing::TestWithParam<std::tuple<double, double>> {
 protected:
  static constexpr int count = 64;
  double angle_ = std::get<0>(GetParam());
  double edge_px_ = std::get<1>(GetParam());
  PixelSlices slices_{std::cos(angle_), std::sin(angle_), edge_px_};

  [[nodiscard]] double across(const PixelPosition& position) const {
    return std::cos(angle_) * (position.along_px - 0.5) + std::sin(angle_) * (position.down_px - 0.5);
  }
};

TEST_P(PixelSlicesAt, AreThePixelTogether) {
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    sum += static_cast<double>(slices_.position(k, count).weight);
  }
  EXPECT_NEAR(sum, count, 1e-4);
}

TEST_P(PixelSlicesAt, HaveTheirPlacesInThePixel) {
  for (int k = 0; k < count; ++k) {
    const PixelPosition position = slices_.position(k, count);
    EXPECT_LE(std::abs(position.along_px - 0.5), 0.5 + 1e-9);
    EXPECT_LE(std::abs(position.down_px - 0.5), 0.5 + 1e-9);
  }
}

TEST_P(PixelSlicesAt, HaveTheirMiddleInThePixelsMiddle) {
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    const PixelPosition position = slices_.position(k, count);
    sum += static_cast<double>(position.weight) * across(position) / count;
  }
  EXPECT_NEAR(sum, 0.0, 2e-3);
}

TEST_P(PixelSlicesAt, AreThinnerNextToTheEdge) {
  double nearest = 1e9;
  double thickness = 0.0;
  double thickest = 0.0;
  for (int k = 0; k + 1 < count; ++k) {
    const double from = across(slices_.position(k, count));
    const double to = across(slices_.position(k + 1, count));
    EXPECT_GT(to, from);
    thickest = std::max(thickest, to - from);
    if (std::abs(0.5 * (from + to) - edge_px_) < nearest) {
      nearest = std::abs(0.5 * (from + to) - edge_px_);
      thickness = to - from;
    }
  }
  EXPECT_LT(thickness, std::abs(edge_px_) < 0.5 ? 0.2 * thickest : thickest);
}

INSTANTIATE_TEST_SUITE_P(Positions, PixelSlicesAt,
                         testing::Combine(testing::Values(0.0, 0.3, 0.785, 1.5707963267948966, 4.0),
                                          testing::Values(-1.2, -0.2, 0.0, 0.4)));

}  // namespace
}  // namespace ergodome
