#include "app/playback/sound/fader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ergodome {
namespace {

using namespace std::chrono_literals;

TEST(Fader, TakesItsTime) {
  Fader fader(2s);
  fader.go(0.0, 10s);
  EXPECT_EQ(fader.value(10s), 1.0);
  EXPECT_DOUBLE_EQ(fader.value(11s), 0.5);
  EXPECT_EQ(fader.value(12s), 0.0);
  EXPECT_EQ(fader.value(1000s), 0.0);
}

TEST(Fader, TurnsRoundFromWhereItIs) {
  Fader fader(2s);
  fader.go(0.0, 10s);
  const double before = fader.value(10500ms);
  fader.go(1.0, 10500ms);
  EXPECT_DOUBLE_EQ(fader.value(10500ms), before);
  EXPECT_LT(fader.value(10900ms), 1.0);
  EXPECT_EQ(fader.value(11s), 1.0) << "the way back is as long as the way there was";
}

TEST(Fader, MovesWithoutSteps) {
  Fader fader(1s);
  fader.go(0.0, 0s);
  double last = 1.0;
  double largest = 0.0;
  for (MonotonicTime now = 0s; now < 1s; now += 1ms) {
    const double value = fader.value(now);
    EXPECT_LE(value, last);
    largest = std::max(largest, last - value);
    last = value;
  }
  EXPECT_LT(largest, 0.0016) << "3 p (1 - p) is 1.5 a second in the middle";
  EXPECT_GT(fader.value(10ms), 1.0 - 0.001) << "it sets out slowly";
}

TEST(Fader, WithoutATimeItSwitches) {
  Fader fader(0s);
  fader.go(0.0, 1s);
  EXPECT_EQ(fader.value(1s), 0.0);
}

TEST(Fader, AnotherTimeKeepsItWhereItIs) {
  Fader fader(2s);
  fader.go(0.0, 10s);
  const double before = fader.value(11s);
  fader.set_whole(10s, 11s);
  EXPECT_DOUBLE_EQ(fader.value(11s), before);
  EXPECT_EQ(fader.value(16s), 0.0);
}

}  // namespace
}  // namespace ergodome
