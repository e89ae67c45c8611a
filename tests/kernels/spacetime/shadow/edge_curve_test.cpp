#include "kernels/spacetime/shadow/edge_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kernels/core/angles.h"

namespace ergodome {
namespace {

struct EdgeTableOf {
  explicit EdgeTableOf(int count) {
    for (int i = 0; i < count; ++i) {
      const double gamma = full_turn * i / count;
      angles.push_back(static_cast<float>(0.5 + 0.1 * std::cos(gamma) + 0.03 * std::sin(2.0 * gamma)));
    }
    curve.polar_angle = angles.data();
    curve.count = count;
  }
  EdgeTableOf(const EdgeTableOf&) = delete;
  EdgeTableOf& operator=(const EdgeTableOf&) = delete;
  ~EdgeTableOf() = default;

  std::vector<float> angles;
  EdgeCurve curve{};
};

void expect_on_curve(const EdgeCurve& edge, double gamma, double within) {
  float alpha = 0.0F;
  float slope = 0.0F;
  edge_at(edge, static_cast<float>(gamma), alpha, slope);
  EXPECT_NEAR(static_cast<double>(alpha), 0.5 + 0.1 * std::cos(gamma) + 0.03 * std::sin(2.0 * gamma), within) << gamma;
  EXPECT_NEAR(static_cast<double>(slope), -0.1 * std::sin(gamma) + 0.06 * std::cos(2.0 * gamma), 1e3 * within) << gamma;
}

TEST(EdgeCurve, IsTheSameWhicheverTurnAnAngleIsIn) {
  for (const int count : {64, 1000, 1024}) {
    const EdgeTableOf edge(count);
    for (int i = -400; i <= 400; ++i) {
      expect_on_curve(edge.curve, 0.0313 * i, 2e-5);
    }
    for (const int turns : {-100, -1, 1, 100}) {
      expect_on_curve(edge.curve, full_turn * turns + 1.0, 1e-4);
    }
  }
}

TEST(EdgeCurve, HasNoJumpWhereTheTableBegins) {
  const EdgeTableOf edge(1000);
  for (const double gamma : {-full_turn, -1e-6, -1e-30, 0.0, 1e-30, 1e-6, full_turn - 1e-6, full_turn}) {
    expect_on_curve(edge.curve, gamma, 1e-5);
  }
}

TEST(EdgeCurve, HasNoPlaceForWhatIsNoAngle) {
  const EdgeTableOf edge(1000);
  for (const float gamma : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
    float alpha = 0.0F;
    float slope = 0.0F;
    edge_at(edge.curve, gamma, alpha, slope);
    EXPECT_TRUE(std::isnan(alpha));
  }
}

}  // namespace
}  // namespace ergodome
