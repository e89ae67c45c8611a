#include "app/pads/pad_response.h"

#include <gmock/gmock.h>

#include <cmath>

namespace ergodome {
namespace {

constexpr PadCurve curved = {.dead_zone = 0.15, .full_at = 0.95, .exponent = 1.5, .expo = 0.3};

//! Returns the layout of a pad with an eight-bit stick and a ten-bit trigger.
RawLayout pad_layout() {
  RawLayout layout;
  layout.axes = {{"left_x", 0, 128, 255, PadAxis::left_x, false},
                 {"left_y", 0, 128, 255, PadAxis::left_y, true},
                 {"left_trigger", 0, 0, 1023, PadAxis::left_trigger, false},
                 {"slider", -512, 0, 511, std::nullopt, false}};
  return layout;
}

PadProfile straight() {
  PadProfile profile;
  profile.left_stick = profile.right_stick = profile.triggers = profile.puck = PadCurve{};
  return profile;
}

RawPad raw(std::int32_t x, std::int32_t y, std::int32_t trigger = 0, std::int32_t slider = 0) {
  RawPad pad;
  pad.values = {x, y, trigger, slider};
  return pad;
}

PadState applied(const PadProfile& profile, const RawPad& pad, const PadState& before = {}) {
  return PadResponse(pad_layout(), profile).apply(pad, {}, before);
}

TEST(PadCurve, IsNothingInTheDeadZoneAndRisesFromItsEdgeWithoutAStep) {
  EXPECT_EQ(shaped(0.15, curved), 0.0);
  EXPECT_GT(shaped(0.16, curved), 0.0);
  EXPECT_LT(shaped(0.15 + 1e-6, curved), 1e-6);
}

TEST(PadCurve, ReachesFullScaleAndStaysThere) {
  EXPECT_DOUBLE_EQ(shaped(0.95, curved), 1.0);
  EXPECT_DOUBLE_EQ(shaped(1.4, curved), 1.0);
}

TEST(PadCurve, RisesAllTheWay) {
  double before = 0.0;
  for (double deflection = 0.16; deflection <= 0.95; deflection += 0.01) {
    EXPECT_GT(shaped(deflection, curved), before);
    before = shaped(deflection, curved);
  }
}

TEST(PadCurve, IsTheFormulaThatIsWritten) {
  // t = (0.55 - 0.15) / (0.95 - 0.15) = 0.5; s = t² = 0.25; the result is 0.5 s + 0.5 s³.
  EXPECT_NEAR(shaped(0.55, {.dead_zone = 0.15, .full_at = 0.95, .exponent = 2.0, .expo = 0.5}), 0.1328125, 1e-12);
}

TEST(PadCurve, TakesNotANumberAsRest) { EXPECT_EQ(shaped(std::nan(""), curved), 0.0); }

TEST(RadialDeadZone, KeepsTheDirection) {
  for (double angle = 0.0; angle < 6.28; angle += 0.1) {
    float stick[2] = {static_cast<float>(0.6 * std::cos(angle)), static_cast<float>(0.6 * std::sin(angle))};
    shape_radially(stick, curved);
    EXPECT_NEAR(std::hypot(stick[0], stick[1]), shaped(0.6, curved), 1e-5);
    EXPECT_NEAR(std::remainder(std::atan2(stick[1], stick[0]) - angle, 6.283185307), 0.0, 1e-5);
  }
}

TEST(RadialDeadZone, IsACircleNotACross) {
  // Each component alone would be within the dead zone of 0.15, but the length of the vector is
  // not.
  float stick[2] = {0.13F, 0.13F};
  shape_radially(stick, curved);
  EXPECT_GT(stick[0], 0.0F);
  float slight[2] = {0.6F, 0.05F};
  shape_radially(slight, curved);
  EXPECT_GT(slight[1], 0.0F);
}

TEST(RadialDeadZone, CornersAreNoLongerThanOne) {
  float stick[2] = {1.0F, 1.0F};
  shape_radially(stick, curved);
  EXPECT_NEAR(std::hypot(stick[0], stick[1]), 1.0F, 1e-6);
}

TEST(PadResponse, TakesEndsAndMiddleToMinusOneNoneAndOne) {
  EXPECT_EQ(applied(straight(), raw(128, 128)), PadState{});
  EXPECT_EQ(applied(straight(), raw(0, 128)).axis(PadAxis::left_x), -1.0F);
  EXPECT_EQ(applied(straight(), raw(255, 128)).axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(applied(straight(), raw(128, 255)).axis(PadAxis::left_y), -1.0F);
  EXPECT_EQ(applied(straight(), raw(128, 0)).axis(PadAxis::left_y), 1.0F);
  EXPECT_EQ(applied(straight(), raw(128, 128, 1023)).axis(PadAxis::left_trigger), 1.0F);
}

TEST(PadResponse, StaysInRangeWhateverADeviceCounts) {
  const PadState beyond = applied(straight(), raw(2'000'000'000, 128, 5000));
  EXPECT_EQ(beyond.axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(beyond.axis(PadAxis::left_trigger), 1.0F);
  EXPECT_EQ(applied(straight(), raw(128, 2'000'000'000)).axis(PadAxis::left_y), -1.0F);
  EXPECT_EQ(applied(straight(), raw(-2'000'000'000, 128, -7)).axis(PadAxis::left_x), -1.0F);
}

TEST(PadResponse, FollowsTheCalibration) {
  PadProfile profile = straight();
  profile.calibration["left_x"] = {28, 140, 240};
  EXPECT_EQ(applied(profile, raw(140, 128)).axis(PadAxis::left_x), 0.0F);
  EXPECT_EQ(applied(profile, raw(28, 128)).axis(PadAxis::left_x), -1.0F);
  EXPECT_EQ(applied(profile, raw(240, 128)).axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(applied(profile, raw(190, 128)).axis(PadAxis::left_x), 0.5F);
}

TEST(PadResponse, InvertsWhatIsToBeInverted) {
  PadProfile profile = straight();
  profile.inverted.set(static_cast<std::size_t>(PadAxis::left_x));
  profile.inverted.set(static_cast<std::size_t>(PadAxis::left_trigger));
  const PadState state = applied(profile, raw(255, 128, 1023));
  EXPECT_EQ(state.axis(PadAxis::left_x), -1.0F);
  EXPECT_EQ(state.axis(PadAxis::left_trigger), 0.0F);
}

TEST(PadResponse, MovesARawAxisElsewhere) {
  PadProfile profile = straight();
  profile.axes["slider"] = {PadAxis::move_up, true};
  profile.axes["left_x"] = {std::nullopt, false};
  const PadState state = applied(profile, raw(255, 128, 0, 511));
  EXPECT_EQ(state.axis(PadAxis::left_x), 0.0F);
  EXPECT_EQ(state.axis(PadAxis::move_up), -1.0F);
}

TEST(PadResponse, TakesTheStrongestOfTwoRawAxesOnOne) {
  PadProfile profile = straight();
  profile.axes["slider"] = {PadAxis::left_x, false};
  EXPECT_EQ(applied(profile, raw(255, 128, 0, -256)).axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(applied(profile, raw(140, 128, 0, -256)).axis(PadAxis::left_x), -0.5F);
}

TEST(PadResponse, LeavesOutWhatIsIgnored) {
  const PadState state = PadResponse(pad_layout(), straight()).apply(raw(255, 0), 0b1, {});
  EXPECT_EQ(state.axis(PadAxis::left_x), 0.0F);
  EXPECT_EQ(state.axis(PadAxis::left_y), 1.0F);
}

TEST(PadResponse, PressesATriggerHalfWayAndLetsItGoBelow) {
  PadState state = applied(straight(), raw(128, 128, 500));
  EXPECT_FALSE(state.pressed(PadButton::left_trigger));
  state = applied(straight(), raw(128, 128, 520), state);
  EXPECT_TRUE(state.pressed(PadButton::left_trigger));
  state = applied(straight(), raw(128, 128, 450), state);
  EXPECT_TRUE(state.pressed(PadButton::left_trigger));
  state = applied(straight(), raw(128, 128, 400), state);
  EXPECT_FALSE(state.pressed(PadButton::left_trigger));
}

TEST(PadResponse, ByDefaultADriftOfTwelveIsRestAndTheEndIsReached) {
  EXPECT_EQ(applied({}, raw(140, 116)), PadState{});
  EXPECT_EQ(applied({}, raw(255, 128)).axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(applied({}, raw(0, 128)).axis(PadAxis::left_x), -1.0F);
}

}  // namespace
}  // namespace ergodome
