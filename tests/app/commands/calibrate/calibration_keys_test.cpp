#include "app/commands/calibrate/calibration_keys.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

using namespace std::chrono_literals;

constexpr int up = 265;
constexpr int down = 264;

TEST(KeyRepeat, AHeldKeyIsDueAfterAWhileAndThenMoreOften) {
  KeyRepeat keys;
  KeyRepeat::Time now;
  keys.press(up, now);
  EXPECT_FALSE(keys.due(now + 399ms));
  EXPECT_EQ(keys.due(now + 400ms), up);
  now += 450ms;
  keys.repeated(now);
  EXPECT_FALSE(keys.due(now + 79ms));
  EXPECT_EQ(keys.due(now + 80ms), up);
}

TEST(KeyRepeat, AKeyThatWasLetGoWhileItsWorkWasDoneIsNotDue) {
  KeyRepeat keys;
  const KeyRepeat::Time now;
  keys.press(up, now);
  EXPECT_FALSE(keys.due(now));
  keys.release(up);
  EXPECT_FALSE(keys.due(now + 2s));
}

TEST(KeyRepeat, TheReleaseOfAnotherKeyDoesNotEndIt) {
  KeyRepeat keys;
  const KeyRepeat::Time now;
  keys.press(up, now);
  keys.press(down, now);
  keys.release(up);
  EXPECT_EQ(keys.due(now + 1s), down);
  keys.release(down);
  EXPECT_FALSE(keys.due(now + 2s));
}

}  // namespace
}  // namespace ergodome
