#include "app/player/outputs/disparity_limit.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

constexpr double comfort_deg = 1.0;

TEST(DisparityLimit, LeavesComfortableEyesAsTheyAre) {
  DisparityLimit limit;
  limit.note(0.0, 0.9, comfort_deg);
  EXPECT_EQ(limit.factor(), 1.0);
  EXPECT_FALSE(limit.take_news());
}

TEST(DisparityLimit, ReducesTheDistanceUntilItIsComfortableAndSaysSoOnce) {
  DisparityLimit limit;
  // Disparities that grow a little faster than the distance between the eyes.
  const auto range_deg = [&] { return 4.0 * limit.factor() * (1.0 + 0.2 * limit.factor()); };
  limit.note(0.0, range_deg(), comfort_deg);
  EXPECT_TRUE(limit.take_news());
  limit.note(1.0, range_deg(), comfort_deg);
  EXPECT_LE(range_deg(), comfort_deg);
  EXPECT_GT(range_deg(), 0.8 * comfort_deg);
  EXPECT_FALSE(limit.take_news());
}

TEST(DisparityLimit, EndsFarFromTheHole) {
  DisparityLimit limit;
  limit.note(0.0, 10.0, comfort_deg);
  for (int i = 1; i <= 20; ++i) {
    limit.note(i, 0.5 * limit.factor(), comfort_deg);
  }
  EXPECT_EQ(limit.factor(), 1.0);
}

TEST(DisparityLimit, MeasuresOncePerSecond) {
  DisparityLimit limit;
  int measured = 0;
  for (int frame = 0; frame < 900; ++frame) {
    const double now_s = frame / 90.0;
    if (limit.is_due(now_s)) {
      ++measured;
      limit.note(now_s, 0.5, comfort_deg);
    }
  }
  EXPECT_EQ(measured, 10);
}

TEST(DisparityLimit, AsksUntilAPictureWasMeasured) {
  const DisparityLimit limit;
  EXPECT_TRUE(limit.is_due(3.0));
  EXPECT_TRUE(limit.is_due(3.01));
}

TEST(DisparityLimit, IgnoresPicturesThatWereRequestedBeforeTheReduction) {
  DisparityLimit limit;
  limit.note(0.0, 2.0, comfort_deg);
  limit.note(0.1, 2.0, comfort_deg);
  EXPECT_EQ(limit.factor(), 0.5);
}

}  // namespace
}  // namespace ergodome
