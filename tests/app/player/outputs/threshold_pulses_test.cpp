#include "app/player/outputs/threshold_pulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace ergodome {
namespace {

//! A pulse and the radius at which it came.
struct Felt {
  double r = 0.0;
  double strength = 0.0;
};

//! Moves in small steps from one radius to another.
std::vector<Felt> move(ThresholdPulses& pulses, double spin, double from, double to, int steps = 2000) {
  std::vector<Felt> felt;
  for (int i = 0; i <= steps; ++i) {
    const double r = std::lerp(from, to, static_cast<double>(i) / steps);
    if (const auto pulse = pulses.advance(Spacetime{spin}, r)) {
      EXPECT_GT(pulse->duration_s, 0.0);
      felt.push_back({r, pulse->strength});
    }
  }
  return felt;
}

std::vector<Felt> move(double spin, double from, double to) {
  ThresholdPulses pulses;
  return move(pulses, spin, from, to);
}

constexpr double step = 10.0 / 2000;

TEST(ThresholdPulses, ComeAtThePhotonOrbitAndTheHorizonWithoutSpin) {
  const std::vector<Felt> felt = move(0.0, 11.0, 1.0);
  ASSERT_EQ(felt.size(), 2U) << "both photon orbits have the same radius";
  EXPECT_NEAR(felt[0].r, 3.0, step);
  EXPECT_NEAR(felt[1].r, 2.0, step);
  EXPECT_GT(felt[1].strength, felt[0].strength);
}

TEST(ThresholdPulses, ComeAtBothPhotonOrbitsWithSpin) {
  // Bardeen, Press & Teukolsky 1972: r = 2 (1 + cos(2/3 arccos(∓a))). With a = 1/√2, arccos(∓a) is
  // 135° and 45°.
  const double spin = 1.0 / std::numbers::sqrt2;
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Felt> felt = move(sign * spin, 11.0, 1.0);
    ASSERT_EQ(felt.size(), 3U);
    EXPECT_NEAR(felt[0].r, 2.0 + std::numbers::sqrt3, step);
    EXPECT_NEAR(felt[1].r, 2.0, step);
    EXPECT_NEAR(felt[2].r, 1.0 + 1.0 / std::numbers::sqrt2, step);
  }
}

TEST(ThresholdPulses, ComeOnTheWayOutToo) {
  const std::vector<Felt> felt = move(0.0, 2.5, 12.5);
  ASSERT_EQ(felt.size(), 1U);
  EXPECT_NEAR(felt[0].r, 3.0, step);
}

TEST(ThresholdPulses, ComeOnceWhileTheCameraHoversAtAThreshold) {
  ThresholdPulses pulses;
  EXPECT_TRUE(move(pulses, 0.0, 3.5, 3.01).empty());
  EXPECT_EQ(move(pulses, 0.0, 3.01, 2.99).size(), 1U);
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(move(pulses, 0.0, 2.99, 3.01).empty());
    EXPECT_TRUE(move(pulses, 0.0, 3.01, 2.99).empty());
  }
}

TEST(ThresholdPulses, ComeAgainAfterTheCameraWasAway) {
  ThresholdPulses pulses;
  EXPECT_EQ(move(pulses, 0.0, 3.5, 2.9).size(), 1U);
  EXPECT_EQ(move(pulses, 0.0, 2.9, 3.1).size(), 1U);
  EXPECT_EQ(move(pulses, 0.0, 3.1, 2.99).size(), 1U);
  EXPECT_TRUE(move(pulses, 0.0, 2.99, 3.1).empty()) << "turned around at the threshold";
  EXPECT_EQ(move(pulses, 0.0, 3.1, 2.9).size(), 1U);
}

TEST(ThresholdPulses, DoNotComeWhenTheCameraJumps) {
  ThresholdPulses pulses;
  EXPECT_TRUE(move(pulses, 0.0, 12.0, 10.0).empty());
  EXPECT_TRUE(move(pulses, 0.0, 2.6, 2.5).empty());
  EXPECT_TRUE(move(pulses, 0.0, 9.0, 8.0).empty());
  EXPECT_TRUE(move(pulses, 0.0, 3.2, 3.1).empty());
  pulses.begin();
  EXPECT_TRUE(move(pulses, 0.0, 2.9, 2.8).empty()) << "another show";
}

TEST(ThresholdPulses, IgnoreARadiusThatIsNotOne) {
  ThresholdPulses pulses;
  EXPECT_TRUE(move(pulses, 0.0, 3.5, 3.1).empty());
  EXPECT_FALSE(pulses.advance(Spacetime{0.0}, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(pulses.advance(Spacetime{0.0}, -1.0));
  EXPECT_EQ(move(pulses, 0.0, 3.1, 2.9).size(), 1U);
}

}  // namespace
}  // namespace ergodome
