#include "render/present/headset/comfort.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "kernels/core/angles.h"
#include "render/present/headset/snap_turns.h"

namespace ergodome {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

//! Advances by `count` frames with the same input, and returns the last state.
ComfortState after_frames(HeadsetComfort& comfort, int count, double seconds, const ComfortInput& input = {}) {
  ComfortState state;
  for (int i = 0; i < count; ++i) {
    state = comfort.advance(seconds, input);
  }
  return state;
}

ComfortInput with_speed(double speed) {
  ComfortInput input;
  input.speed = speed;
  return input;
}

ComfortInput with_snap_turns(double steps) {
  ComfortInput input;
  input.snap_turn = steps;
  return input;
}

ComfortInput with_cut() {
  ComfortInput input;
  input.cut = true;
  return input;
}

ComfortInput with_exposure(double stops) {
  ComfortInput input;
  input.exposure_stops = stops;
  return input;
}

TEST(HeadsetComfort, ClosesTheVignetteFastAndOpensItSlowly) {
  HeadsetComfort comfort({});
  EXPECT_EQ(comfort.advance(0.01, {}).vignette, 0.0);
  EXPECT_NEAR(comfort.advance(0.075, with_speed(0.6)).vignette, 0.5, 1e-12);
  const ComfortState closed = comfort.advance(0.0751, with_speed(0.6));
  EXPECT_EQ(closed.vignette, 1.0);
  EXPECT_NEAR(closed.clear_half_angle_rad, 35.0 * one_degree, 1e-12);
  EXPECT_NEAR(comfort.advance(0.25, {}).vignette, 0.5, 1e-12);
  const ComfortState open = comfort.advance(0.2501, {});
  EXPECT_EQ(open.vignette, 0.0);
  EXPECT_NEAR(open.clear_half_angle_rad, 60.0 * one_degree, 1e-12);
}

TEST(HeadsetComfort, HasAVignetteThatGrowsWithTheSpeedUpToItsStrength) {
  HeadsetSettings weak;
  weak.vignette = 0.4;
  HeadsetSettings off;
  off.vignette = 0.0;
  double before = 0.0;
  for (const double speed : {0.0, 0.01, 0.1, 0.2, 0.3, 0.4, 0.6, 10.0}) {
    HeadsetComfort strong({});
    HeadsetComfort weaker(weak);
    HeadsetComfort none(off);
    const double vignette = after_frames(strong, 100, 0.01, with_speed(speed)).vignette;
    EXPECT_GE(vignette, before) << speed;
    EXPECT_NEAR(after_frames(weaker, 100, 0.01, with_speed(speed)).vignette, 0.4 * vignette, 1e-12) << speed;
    EXPECT_EQ(after_frames(none, 100, 0.01, with_speed(speed)).vignette, 0.0) << speed;
    before = vignette;
  }
  EXPECT_EQ(before, 1.0);
  HeadsetComfort halfway({});
  const double vignette = after_frames(halfway, 100, 0.01, with_speed(0.25)).vignette;
  EXPECT_GT(vignette, 0.4);
  EXPECT_LT(vignette, 0.6);
}

TEST(HeadsetComfort, IsBlackAtACutAndFadesIn) {
  HeadsetComfort comfort({});
  EXPECT_EQ(comfort.advance(0.01, {}).light, 1.0);
  EXPECT_EQ(comfort.advance(0.01, with_cut()).light, 0.0);
  EXPECT_NEAR(comfort.advance(0.1, {}).light, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(comfort.advance(0.1, {}).light, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(comfort.advance(0.1001, {}).light, 1.0);
  EXPECT_EQ(comfort.advance(5.0, with_cut()).light, 0.0) << "also in a late frame";
}

TEST(HeadsetComfort, TurnsOnlyInTheDark) {
  HeadsetSettings settings;
  for (const double fade_s : {0.01, 0.1, 0.3, 5.0}) {
    settings.fade_s = fade_s;
    for (const double frame_s : {1.0 / 120.0, 1.0 / 72.0, 0.1, 1.0}) {
      HeadsetComfort comfort(settings);
      double yaw_rad = comfort.advance(frame_s, with_snap_turns(1.0)).yaw_rad;
      EXPECT_EQ(yaw_rad, 0.0);
      int jumps = 0;
      double light = 0.0;
      for (double time_s = 0.0; time_s < fade_s + 2.0 * frame_s; time_s += frame_s) {
        const ComfortState state = comfort.advance(frame_s, {});
        if (state.yaw_rad != yaw_rad) {
          ++jumps;
          EXPECT_EQ(state.light, 0.0) << fade_s << ' ' << frame_s;
        }
        yaw_rad = state.yaw_rad;
        light = state.light;
      }
      EXPECT_EQ(jumps, 1) << fade_s << ' ' << frame_s;
      EXPECT_NEAR(yaw_rad, 30.0 * one_degree, 1e-12);
      EXPECT_EQ(light, 1.0) << fade_s << ' ' << frame_s;
    }
  }
}

TEST(HeadsetComfort, FadesOutBeforeATurnAndInAfterIt) {
  HeadsetComfort comfort({});
  EXPECT_EQ(comfort.advance(0.01, with_snap_turns(-1.0)).light, 1.0);
  // 0.13 s out, 0.04 s dark, 0.13 s in.
  EXPECT_NEAR(comfort.advance(0.065, {}).light, 0.5, 1e-9);
  ComfortState state = comfort.advance(0.066, {});
  EXPECT_EQ(state.light, 0.0);
  EXPECT_NEAR(state.yaw_rad, -30.0 * one_degree, 1e-12);
  EXPECT_EQ(comfort.advance(0.038, {}).light, 0.0);
  EXPECT_NEAR(comfort.advance(0.066, {}).light, 0.5, 1e-9);
  EXPECT_EQ(comfort.advance(0.066, {}).light, 1.0);
}

TEST(HeadsetComfort, AddsTurnsThatComeBeforeTheDark) {
  HeadsetComfort comfort({});
  comfort.advance(0.01, with_snap_turns(1.0));
  comfort.advance(0.05, with_snap_turns(1.0));
  const ComfortState before = comfort.advance(0.05, {});
  EXPECT_EQ(before.yaw_rad, 0.0);
  EXPECT_GT(before.light, 0.0);
  EXPECT_NEAR(comfort.advance(0.05, {}).yaw_rad, 60.0 * one_degree, 1e-12);

  HeadsetComfort changed_mind({});
  changed_mind.advance(0.01, with_snap_turns(1.0));
  const double light = changed_mind.advance(0.05, with_snap_turns(-1.0)).light;
  const ComfortState state = changed_mind.advance(0.01, {});
  EXPECT_EQ(state.yaw_rad, 0.0);
  EXPECT_GT(state.light, light);
  EXPECT_LT(state.light, 0.9) << "does not flash";

  HeadsetComfort cut_meanwhile({});
  cut_meanwhile.advance(0.01, with_snap_turns(1.0));
  const ComfortState dark = cut_meanwhile.advance(0.01, with_cut());
  EXPECT_EQ(dark.light, 0.0);
  EXPECT_NEAR(dark.yaw_rad, 30.0 * one_degree, 1e-12) << "a cut is dark";
}

TEST(HeadsetComfort, WithoutFadesActsAtOnce) {
  HeadsetSettings settings;
  settings.fade_s = 0.0;
  HeadsetComfort comfort(settings);
  for (int turns = 1; turns <= 6; ++turns) {
    ComfortInput input = with_cut();
    input.snap_turn = 1.0;
    const ComfortState state = comfort.advance(0.01, input);
    EXPECT_EQ(state.light, 1.0);
    EXPECT_NEAR(std::remainder(state.yaw_rad - turns * 30.0 * one_degree, full_turn), 0.0, 1e-12);
  }
  for (int turns = 0; turns < 100; ++turns) {
    EXPECT_LE(std::abs(comfort.advance(0.01, with_snap_turns(1.0)).yaw_rad), pi);
  }
}

TEST(HeadsetComfort, TurnsSmoothlyOnlyWithoutSnapTurns) {
  ComfortInput input;
  input.smooth_turn = 1.0;
  HeadsetComfort snapping({});
  EXPECT_EQ(after_frames(snapping, 50, 0.01, input).yaw_rad, 0.0);
  HeadsetSettings settings;
  settings.snap_turn_deg = 0.0;
  HeadsetComfort smooth(settings);
  input.snap_turn = 1.0;
  const ComfortState state = after_frames(smooth, 50, 0.01, input);
  EXPECT_NEAR(state.yaw_rad, 22.5 * one_degree, 1e-12);
  EXPECT_EQ(state.light, 1.0);
  EXPECT_EQ(state.vignette, 1.0) << "a turn moves the view, too";
}

TEST(HeadsetComfort, LimitsChangesOfTheExposure) {
  HeadsetComfort comfort({});
  EXPECT_EQ(comfort.advance(0.01, with_exposure(-3.0)).exposure_stops, -3.0) << "the first frame has no history";
  EXPECT_NEAR(after_frames(comfort, 50, 0.01, with_exposure(5.0)).exposure_stops, -2.5, 1e-9);
  EXPECT_NEAR(after_frames(comfort, 100, 0.01, with_exposure(-9.0)).exposure_stops, -3.5, 1e-9);
  EXPECT_EQ(comfort.advance(0.6, with_exposure(-4.0)).exposure_stops, -4.0) << "does not overshoot";
  ComfortInput jump = with_cut();
  jump.exposure_stops = 6.0;
  EXPECT_EQ(comfort.advance(0.01, jump).exposure_stops, 6.0);
  HeadsetSettings settings;
  settings.exposure_rate = 4.0;
  comfort.change(settings);
  EXPECT_NEAR(comfort.advance(0.5, with_exposure(0.0)).exposure_stops, 4.0, 1e-12);
  settings.exposure_rate = 0.0;
  comfort.change(settings);
  EXPECT_EQ(comfort.advance(0.001, with_exposure(-20.0)).exposure_stops, -20.0);
}

//! Returns the states of a busy second and a half, every 24th of a second, for frames of 1 / rate_hz.
std::vector<ComfortState> states_at_rate(const HeadsetSettings& settings, int rate_hz) {
  HeadsetComfort comfort(settings);
  std::vector<ComfortState> states;
  for (int frame = 1; frame <= 3 * rate_hz / 2; ++frame) {
    const int part = 24 * (frame - 1) / rate_hz;
    const bool ends_part = 24 * frame % rate_hz == 0;
    ComfortInput input;
    input.speed = part < 6 ? 0.6 : part < 14 ? 0.1 : 0.0;
    input.smooth_turn = part < 20 ? 0.0 : -0.7;
    input.exposure_stops = frame == 1 ? 0.0 : part < 12 ? 3.0 : -3.0;
    input.cut = ends_part && part == 15;
    input.snap_turn = ends_part && (part == 2 || part == 5 || part == 27) ? 1.0 : 0.0;
    const ComfortState state = comfort.advance(1.0 / rate_hz, input);
    if (ends_part) {
      states.push_back(state);
    }
  }
  return states;
}

TEST(HeadsetComfort, DoesNotDependOnTheFrameRate) {
  for (const double snap_turn_deg : {0.0, 30.0}) {
    HeadsetSettings settings;
    settings.snap_turn_deg = snap_turn_deg;
    const std::vector<ComfortState> slow = states_at_rate(settings, 72);
    const std::vector<ComfortState> fast = states_at_rate(settings, 120);
    ASSERT_EQ(slow.size(), 36);
    ASSERT_EQ(fast.size(), slow.size());
    for (std::size_t i = 0; i < slow.size(); ++i) {
      EXPECT_NEAR(slow[i].vignette, fast[i].vignette, 1e-9) << i;
      EXPECT_NEAR(slow[i].light, fast[i].light, 1e-9) << i;
      EXPECT_NEAR(slow[i].yaw_rad, fast[i].yaw_rad, 1e-9) << i;
      EXPECT_NEAR(slow[i].exposure_stops, fast[i].exposure_stops, 0.02) << i;
    }
  }
}

TEST(HeadsetComfort, StaysWithinLimitsWhateverTheInput) {
  const std::vector<double> hostile = {nan_value, infinite, -infinite, 1e308, -1e308, 5e-324, 0.0, -1.0, 0.3, 1.0};
  unsigned random = 1;
  const auto any = [&] {
    random = random * 1664525U + 1013904223U;
    return hostile[(random >> 16U) % hostile.size()];
  };
  for (int round = 0; round < 300; ++round) {
    HeadsetSettings settings;
    settings.vignette = any();
    settings.fade_s = any();
    settings.snap_turn_deg = round % 2 == 0 ? 30.0 : any();
    settings.exposure_rate = any();
    HeadsetComfort comfort(settings);
    for (int frame = 0; frame < 100; ++frame) {
      ComfortInput input;
      input.speed = any();
      input.cut = any() > 0.5;
      input.snap_turn = any();
      input.smooth_turn = any();
      input.exposure_stops = any();
      const ComfortState state = comfort.advance(any(), input);
      ASSERT_TRUE(state.vignette >= 0.0 && state.vignette <= 1.0) << round;
      ASSERT_TRUE(state.light >= 0.0 && state.light <= 1.0) << round;
      ASSERT_TRUE(std::abs(state.yaw_rad) <= pi) << round;
      ASSERT_TRUE(std::abs(state.exposure_stops) <= max_comfort_stops) << round;
      ASSERT_TRUE(state.clear_half_angle_rad >= 34.9 * one_degree && state.clear_half_angle_rad <= 60.1 * one_degree);
    }
    // It recovers: after a long rest it is as after its construction.
    comfort.advance(3600.0, {});
    const ComfortState state = comfort.advance(3600.0, {});
    ASSERT_EQ(state.vignette, 0.0) << round;
    ASSERT_EQ(state.light, 1.0) << round;
  }
}

TEST(HeadsetComfort, TakesNaNForZero) {
  HeadsetComfort comfort({});
  after_frames(comfort, 100, 0.01, with_speed(1.0));
  ComfortInput input;
  input.speed = nan_value;
  input.snap_turn = nan_value;
  input.smooth_turn = nan_value;
  input.exposure_stops = nan_value;
  EXPECT_EQ(comfort.advance(nan_value, input).vignette, 1.0) << "no time has passed";
  const ComfortState state = comfort.advance(1.0, input);
  EXPECT_EQ(state.vignette, 0.0);
  EXPECT_EQ(state.light, 1.0);
  EXPECT_EQ(state.yaw_rad, 0.0);
  EXPECT_EQ(state.exposure_stops, 0.0);
}

TEST(SnapTurns, TurnOnceForEachPush) {
  SnapTurns turns;
  const std::vector<std::pair<double, int>> pushes = {
      {0.0, 0}, {0.69, 0}, {0.71, 1},  {1.0, 0},  {0.5, 0}, {0.9, 0},       {0.41, 0}, {0.8, 0}, {0.39, 0}, {0.71, 1},
      {0.2, 0}, {-0.5, 0}, {-0.8, -1}, {-1.0, 0}, {0.9, 1}, {nan_value, 0}, {0.75, 1}, {0.0, 0}, {-9.0, -1}};
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    EXPECT_EQ(turns.turn(pushes[i].first), pushes[i].second) << i;
  }
}

}  // namespace
}  // namespace ergodome
