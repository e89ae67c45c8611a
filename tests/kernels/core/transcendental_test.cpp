#include "kernels/core/transcendental.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/lanes.h"

namespace ergodome {
namespace {

using Wide = WidePack<float>;

constexpr float rounding = std::numeric_limits<float>::epsilon();

Wide filled(float value) { return Wide(value); }

TEST(Transcendental, LogarithmOfPacksIsTheLibrarys) {
  for (float x = 1e-30F; x < 1e30F; x *= 1.37F) {
    const float exact = static_cast<float>(std::log(static_cast<double>(x)));
    EXPECT_NEAR(lane(natural_logarithm(filled(x)), 0), exact, 3.0F * rounding * std::max(std::abs(exact), 0.5F)) << x;
  }
}

TEST(Transcendental, ExponentialOfPacksIsTheLibrarys) {
  for (float x = -80.0F; x < 80.0F; x += 0.173F) {
    const float exact = static_cast<float>(std::exp(static_cast<double>(x)));
    EXPECT_NEAR(lane(exponential(filled(x)), 0), exact, 4.0F * rounding * exact) << x;
  }
}

TEST(Transcendental, ArcTangentOfPacksIsTheLibrarysInAllQuadrants) {
  for (float angle = -3.14F; angle < 3.14F; angle += 0.0137F) {
    for (const float length : {1e-20F, 1.0F, 1e15F}) {
      const float y = length * std::sin(angle);
      const float x = length * std::cos(angle);
      EXPECT_NEAR(lane(arc_tangent(filled(y), filled(x)), 0), std::atan2(y, x), 4.0F * rounding * 3.0F) << angle;
    }
  }
}

TEST(Transcendental, ArcTangentOfTheAxesAndTheOriginIsExact) {
  EXPECT_EQ(lane(arc_tangent(filled(0.0F), filled(0.0F)), 0), 0.0F);
  EXPECT_EQ(lane(arc_tangent(filled(0.0F), filled(1.0F)), 0), 0.0F);
  EXPECT_FLOAT_EQ(lane(arc_tangent(filled(1.0F), filled(0.0F)), 0), 1.57079632679F);
  EXPECT_FLOAT_EQ(lane(arc_tangent(filled(0.0F), filled(-1.0F)), 0), 3.14159265359F);
}

}  // namespace
}  // namespace ergodome
