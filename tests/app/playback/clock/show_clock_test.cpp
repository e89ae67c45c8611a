#include "app/playback/clock/show_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/app/playback/fake_time.h"

namespace ergodome {
namespace {

using namespace std::chrono_literals;
using test::FakeTime;

TEST(ShowTime, SecondsBecomeTheNearestNanosecond) {
  EXPECT_EQ(show_time(1.5), 1500ms);
  EXPECT_EQ(show_time(-0.1), -100ms);
  EXPECT_EQ(show_time(999999999.25), 999999999s + 250ms);
}

TEST(ShowTime, WhatIsNoTimeIsTamed) {
  EXPECT_EQ(show_time(std::nan("")), 0ns);
  EXPECT_EQ(show_time(std::numeric_limits<double>::infinity()), 4000000000s);
}

TEST(FrameRate, TelevisionsRatesAreThousandAndFirstParts) {
  EXPECT_EQ(frame_rate_of(29.97), (FrameRate{30000, 1001}));
  EXPECT_EQ(frame_rate_of(23.976), (FrameRate{24000, 1001}));
  EXPECT_EQ(frame_rate_of(59.94), (FrameRate{60000, 1001}));
  EXPECT_EQ(frame_rate_of(23.98), (FrameRate{24000, 1001}));
  EXPECT_EQ(frame_rate_of(59.9395), (FrameRate{60000, 1001}));
  EXPECT_EQ(frame_rate_of(60.0), (FrameRate{60, 1}));
  EXPECT_EQ(frame_rate_of(12.5), (FrameRate{12'500'000, 1'000'000}));
}

TEST(FrameRate, AFrameBeginsWhereItsTimeSays) {
  for (const FrameRate rate : {FrameRate{24, 1}, FrameRate{30000, 1001}, FrameRate{60, 1}}) {
    for (const std::int64_t frame :
         {std::int64_t{-7}, std::int64_t{0}, std::int64_t{1}, std::int64_t{29'970'029'970}}) {
      EXPECT_EQ(frame_at(time_of_frame(frame, rate), rate), frame);
      EXPECT_EQ(frame_at(time_of_frame(frame, rate) - 1ns, rate), frame - 1);
    }
  }
}

TEST(ShowClock, StandsUntilItIsPlayed) {
  FakeTime time;
  ShowClock clock(60.0, 30.0, time.source());
  time.pass(3.0);
  EXPECT_EQ(clock.read().time, 0s);
  clock.play();
  time.pass(3.0);
  EXPECT_EQ(clock.read().time, 3s);
  clock.pause();
  time.pass(3.0);
  EXPECT_EQ(clock.read().time, 3s);
}

TEST(ShowClock, AnHourWithStallsEndsWithinAFrameAndCountsWhatItDropped) {
  FakeTime time;
  ShowClock clock(7200.0, 29.97, time.source());
  clock.play();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> frame_s(0.001, 0.04);
  std::uniform_real_distribution<double> stall_s(0.5, 9.0);
  const MonotonicTime start = time.now;
  long shown = 0;
  std::int64_t last = -1;
  while (time.now - start < 1h) {
    const ShowInstant instant = clock.read();
    clock.note_shown(instant);
    shown += instant.frame != last ? 1 : 0;
    last = instant.frame;
    time.pass(random() % 200 == 0 ? stall_s(random) : frame_s(random));
  }
  time.now = start + 1h;
  const ShowInstant end = clock.read();
  EXPECT_EQ(end.time, 1h);
  EXPECT_EQ(end.frame, 107892);  // 3600 * 30000 / 1001 = 107892.1
  EXPECT_GT(clock.dropped_frames(), 1000);
  EXPECT_EQ(clock.dropped_frames() + shown, last + 1);
}

TEST(ShowClock, ChangesOfSpeedLeaveNoRoundingBehind) {
  FakeTime time;
  ShowClock clock(0.0, 60.0, time.source());
  clock.play();
  // The speed changes 100,000 times between two values whose mean is 1. Each step is not a whole
  // number of nanoseconds, so rounding errors could add up.
  for (int i = 0; i < 100'000; ++i) {
    clock.set_speed(i % 2 == 0 ? 0.75 : 1.25);
    time.now += 16'666'667ns;
  }
  EXPECT_EQ(clock.read().time, 100'000 * 16'666'667ns);
}

TEST(ShowClock, StepsBetweenFramesAreExactAfterAThousandMillionSeconds) {
  FakeTime time;
  ShowClock clock(0.0, 60.0, time.source());
  clock.play();
  time.now += 1'000'000'000s;
  ShowTime last = clock.read().time;
  EXPECT_EQ(last, 1'000'000'000s);
  for (int i = 0; i < 1000; ++i) {
    time.now += 16'666'667ns;
    const ShowTime now = clock.read().time;
    ASSERT_EQ(now - last, 16'666'667ns);
    last = now;
  }
}

TEST(ShowClock, ALoopedShowIsInStepAfterAThousandMillionSeconds) {
  FakeTime time;
  ShowClock clock(61.7, 30.0, time.source());
  clock.play();
  time.now += 1'000'000'000s;
  const ShowInstant instant = clock.read();
  EXPECT_EQ(instant.time, ShowTime(1'000'000'000'000'000'000 % 61'700'000'000));
  EXPECT_EQ(instant.pass, 1'000'000'000'000'000'000 / 61'700'000'000);
}

TEST(ShowClock, RunsAtAnySpeedForthAndBack) {
  FakeTime time;
  ShowClock clock(60.0, 30.0, time.source());
  clock.seek(10s);
  clock.play();
  clock.set_speed(2.5);
  time.pass(4.0);
  EXPECT_EQ(clock.read().time, 20s);
  clock.set_speed(-0.5);
  time.pass(10.0);
  EXPECT_EQ(clock.read().time, 15s);
  time.pass(40.0);
  EXPECT_EQ(clock.read().time, 55s) << "back over the start comes in at the end";
}

TEST(ShowClock, WithoutALoopItStopsAtItsEndAndShowsTheLastFrame) {
  FakeTime time;
  ShowClock clock(2.0, 30.0, time.source());
  clock.set_loop(false);
  clock.play();
  time.pass(5.0);
  const ShowInstant end = clock.read();
  EXPECT_EQ(end.time, 2s);
  EXPECT_EQ(end.frame, 59);
  EXPECT_FALSE(end.playing);
  clock.play();
  time.pass(0.5);
  EXPECT_EQ(clock.read().time, 500ms) << "played again, it restarts";
}

TEST(ShowClock, WithoutALoopItStopsAtItsStartBackwards) {
  FakeTime time;
  ShowClock clock(2.0, 30.0, time.source());
  clock.set_loop(false);
  clock.seek(1s);
  clock.set_speed(-1.0);
  clock.play();
  time.pass(5.0);
  EXPECT_EQ(clock.read().time, 0s);
  EXPECT_FALSE(clock.read().playing);
}

TEST(ShowClock, AShowWithoutALengthRunsOn) {
  FakeTime time;
  ShowClock clock(0.0, 30.0, time.source());
  clock.play();
  time.pass(1e6);
  EXPECT_EQ(clock.read().time, 1'000'000s);
  EXPECT_TRUE(clock.read().playing);
}

TEST(ShowClock, SeeksStayWithinTheShow) {
  FakeTime time;
  ShowClock clock(60.0, 30.0, time.source());
  clock.set_loop(false);
  clock.seek(100s);
  EXPECT_EQ(clock.read().time, 60s);
  clock.seek(-1s);
  EXPECT_EQ(clock.read().time, 0s);
  clock.seek_by(-1s);
  EXPECT_EQ(clock.read().time, 0s);
  clock.set_loop(true);
  clock.seek_by(-1s);
  EXPECT_EQ(clock.read().time, 59s) << "a loop is gone round";
}

TEST(ShowClock, StepsGoFromStartToStartOfFrames) {
  FakeTime time;
  ShowClock clock(60.0, 29.97, time.source());
  clock.play();
  time.pass(1.01);  // frame 30 starts at 1.001 s
  clock.step(1);
  EXPECT_FALSE(clock.playing());
  EXPECT_EQ(clock.read().frame, 31);
  EXPECT_EQ(clock.read().time, time_of_frame(31, {30000, 1001}));
  clock.step(-2);
  EXPECT_EQ(clock.read().frame, 29);
  clock.step(-30);
  EXPECT_EQ(clock.read().frame, 1798) << "60 s have 1799 frames; -1 is the last one of the loop";
  clock.set_loop(false);
  clock.step(1000);
  EXPECT_EQ(clock.read().frame, 1798);
}

TEST(ShowClock, EndsOfLoopsDropNoFrames) {
  FakeTime time;
  ShowClock clock(2.0, 30.0, time.source());
  clock.play();
  for (int i = 0; i < 600; ++i) {
    clock.note_shown(clock.read());
    time.pass(1.0 / 60.0);
  }
  EXPECT_EQ(clock.dropped_frames(), 0);
}

TEST(ShowClock, SeeksDropNoFrames) {
  FakeTime time;
  ShowClock clock(60.0, 30.0, time.source());
  clock.play();
  clock.note_shown(clock.read());
  clock.seek(30s);
  clock.note_shown(clock.read());
  EXPECT_EQ(clock.dropped_frames(), 0);
}

TEST(ShowClock, AnotherVersionOfAShowGoesOnWhereItWas) {
  FakeTime time;
  ShowClock clock(60.0, 30.0, time.source());
  clock.play();
  time.pass(20.0);
  clock.set_show(30.0, 60.0);
  EXPECT_EQ(clock.read().time, 20s);
  clock.set_loop(false);
  clock.set_show(10.0, 60.0);
  EXPECT_EQ(clock.read().time, 10s);
}

TEST(ShowClock, WhatIsNoSpeedIsIgnored) {
  FakeTime time;
  ShowClock clock(60.0, 30.0, time.source());
  clock.set_speed(2.0);
  clock.set_speed(std::nan(""));
  EXPECT_EQ(clock.speed(), 2.0);
  clock.set_speed(-1e300);
  EXPECT_EQ(clock.speed(), -1000.0);
}

}  // namespace
}  // namespace ergodome
