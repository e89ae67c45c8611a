#include "app/playback/external_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/app/playback/fake_time.h"

namespace ergodome {
namespace {

using namespace std::chrono_literals;
using test::FakeTime;

//! A show that follows another clock at 60 frames per second.
struct Chase {
  FakeTime time;
  ShowClock clock{600.0, 30.0, time.source()};
  ClockChaser chaser;
  std::optional<ClockFix> fix;
  ChaseState state = ChaseState::waiting;
  std::chrono::nanoseconds patience = 1s;

  //! Returns a fix of the other clock: its show time and speed at the moment `ahead` after now.
  [[nodiscard]] ClockFix word(ShowTime show_time, double speed, std::chrono::nanoseconds ahead = 0s) const {
    return {show_time, speed, time.now + ahead, time.now};
  }

  ShowInstant frame() {
    time.pass(1.0 / 60.0);
    state = chaser.follow(clock, fix, patience);
    return clock.read();
  }
};

TEST(ClockChaser, StandsUntilItHearsSomething) {
  Chase chase;
  chase.clock.play();
  chase.frame();
  EXPECT_EQ(chase.state, ChaseState::waiting);
  EXPECT_FALSE(chase.clock.playing());
}

TEST(ClockChaser, JumpsToWhereTheOtherClockIs) {
  Chase chase;
  chase.fix = chase.word(100s, 1.0);
  const ShowInstant now = chase.frame();
  EXPECT_EQ(chase.state, ChaseState::following);
  EXPECT_TRUE(now.playing);
  EXPECT_NEAR(seconds_of(now.time), 100.0 + 1.0 / 60.0, 1e-8);
}

TEST(ClockChaser, SlewsSmallErrorsWithoutAJump) {
  Chase chase;
  chase.fix = chase.word(100s, 1.0);
  const long jumps = chase.frame().jumps;
  double last_s = seconds_of(chase.clock.read().time);
  for (int i = 0; i < 300; ++i) {
    chase.fix = chase.word(100s + (chase.time.now - FakeTime{}.now) + 50ms, 1.0);
    const double now_s = seconds_of(chase.frame().time);
    EXPECT_NEAR(now_s - last_s, 1.0 / 60.0, 0.1 / 60.0 + 1e-6) << "no step is more than a tenth longer";
    last_s = now_s;
  }
  EXPECT_EQ(chase.clock.read().jumps, jumps);
  EXPECT_NEAR(last_s, 100.0 + seconds_of(chase.time.now - FakeTime{}.now) + 0.05, 1e-3);
}

TEST(ClockChaser, KeepsInStepWithAClockThatRunsALittleFast) {
  Chase chase;
  std::mt19937 random(1);
  double worst_s = 0.0;
  for (int i = 0; i < 3600; ++i) {
    const double other_s = 10.0 + 1.0003 * seconds_of(chase.time.now - FakeTime{}.now);
    chase.fix = chase.word(show_time(other_s), 1.0);
    const double own_s = seconds_of(chase.frame().time);
    const double then_s = 10.0 + 1.0003 * seconds_of(chase.time.now - FakeTime{}.now);
    worst_s = std::max(worst_s, std::abs(own_s - then_s));
  }
  EXPECT_LT(worst_s, 0.001);
}

TEST(ClockChaser, FollowsBackwardsAndAtOtherSpeeds) {
  Chase chase;
  chase.fix = chase.word(100s, -2.0);
  for (int i = 0; i < 30; ++i) {
    chase.frame();
  }
  EXPECT_NEAR(seconds_of(chase.clock.read().time), 99.0, 1e-6);
}

TEST(ClockChaser, FollowsAClockThatSpeaksTwiceASecondWithoutAWordOfLosingIt) {
  Chase chase;
  chase.patience = 2s;
  for (int i = 0; i < 120; ++i) {
    if (i % 30 == 0) {
      chase.fix = chase.word(100s + (chase.time.now - FakeTime{}.now), 1.0);
    }
    chase.frame();
    ASSERT_EQ(chase.state, ChaseState::following) << i;
  }
}

TEST(ClockChaser, RunsOnForAMomentWhenNothingComesAndThenStops) {
  Chase chase;
  chase.fix = chase.word(100s, 1.0);
  for (int i = 0; i < 36; ++i) {
    chase.frame();
  }
  EXPECT_EQ(chase.state, ChaseState::freewheeling);
  EXPECT_NEAR(seconds_of(chase.clock.read().time), 100.6, 1e-6);
  for (int i = 0; i < 60; ++i) {
    chase.frame();
  }
  EXPECT_EQ(chase.state, ChaseState::held);
  const ShowTime held = chase.clock.read().time;
  EXPECT_NEAR(seconds_of(held), 101.0, 0.03);
  chase.frame();
  EXPECT_EQ(chase.clock.read().time, held);
  chase.fix = chase.word(300s, 1.0);
  chase.frame();
  EXPECT_EQ(chase.state, ChaseState::following);
  EXPECT_TRUE(chase.clock.playing());
}

TEST(ClockChaser, CountsSilenceFromWhenAWordCameWhateverTimeItIsOf) {
  for (const auto ahead : {-5s, 5s}) {
    Chase chase;
    for (int i = 0; i < 60; ++i) {
      chase.fix = chase.word(100s + (chase.time.now - FakeTime{}.now), 1.0, ahead);
      chase.frame();
      ASSERT_EQ(chase.state, ChaseState::following) << ahead.count();
    }
    EXPECT_TRUE(chase.clock.playing());
    EXPECT_NEAR(seconds_of(chase.clock.read().time), 101.0 - seconds_of(ahead), 1e-6);
    for (int i = 0; i < 62; ++i) {
      chase.frame();
    }
    EXPECT_EQ(chase.state, ChaseState::held) << ahead.count();
    EXPECT_NEAR(seconds_of(chase.clock.read().time), 102.0 - seconds_of(ahead), 0.03);
  }
}

TEST(ClockChaser, StandsExactlyWhereAStoppedClockStands) {
  Chase chase;
  chase.fix = chase.word(100s, 1.0);
  chase.frame();
  chase.fix = chase.word(250s, 0.0);
  for (int i = 0; i < 200; ++i) {
    chase.frame();
  }
  EXPECT_EQ(chase.state, ChaseState::following) << "a clock that stands has nothing to say";
  EXPECT_EQ(chase.clock.read().time, 250s);
  EXPECT_FALSE(chase.clock.playing());
}

TEST(ClockChaser, FollowsRoundALoopWithoutAJumpBack) {
  Chase chase;
  chase.fix = chase.word(599500ms, 1.0);
  for (int i = 0; i < 60; ++i) {
    chase.frame();
  }
  EXPECT_NEAR(seconds_of(chase.clock.read().time), 0.5, 1e-6);
  EXPECT_EQ(chase.clock.read().pass, 1);
}

TEST(ClockChaser, RestsAtTheEndOfAShowThatDoesNotLoop) {
  Chase chase;
  chase.clock.set_loop(false);
  chase.fix = chase.word(599900ms, 1.0);
  for (int i = 0; i < 30; ++i) {
    chase.frame();
  }
  EXPECT_EQ(chase.clock.read().time, 600s);
  EXPECT_FALSE(chase.clock.playing());
}

}  // namespace
}  // namespace ergodome
