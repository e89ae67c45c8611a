#include "app/player/stereo_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace ergodome {
namespace {

StereoSettings pressed(StereoSettings stereo, KeyAction action, int times) {
  const StereoSettings shown = {StereoLayout::rows, StereoModel::physical, 0.1};
  for (int i = 0; i < times; ++i) {
    stereo = adjusted(stereo, action, shown, 10.0);
  }
  return stereo;
}

TEST(StereoControls, BaselineGoesFromNothingToLargerThanTheHoleAndBack) {
  const StereoSettings none = {StereoLayout::rows, StereoModel::physical, 0.0};
  EXPECT_GT(pressed(none, KeyAction::baseline_larger, 1).baseline, 0.0);
  const StereoSettings large = pressed(none, KeyAction::baseline_larger, 60);
  EXPECT_GT(large.baseline, 100.0);
  EXPECT_LE(pressed(large, KeyAction::baseline_larger, 100).baseline, 1000.0);
  EXPECT_EQ(pressed(large, KeyAction::baseline_smaller, 100).baseline, 0.0);
  EXPECT_EQ(pressed(large, KeyAction::baseline_reset, 1).baseline, 0.1);
}

TEST(StereoControls, ConvergenceGoesToInfinityAndComesBack) {
  const StereoSettings far = {StereoLayout::rows, StereoModel::physical, 0.1};
  const StereoSettings near = pressed(far, KeyAction::convergence_nearer, 100);
  EXPECT_NEAR(near.convergence, 0.1, 1e-12);
  EXPECT_EQ(pressed(near, KeyAction::convergence_farther, 100).convergence, 0.0);
}

TEST(StereoControls, FirstPressesFromNothingAndFromInfinityAreSeen) {
  StereoSettings stereo = {StereoLayout::rows, StereoModel::physical, 0.0};
  EXPECT_DOUBLE_EQ(pressed(stereo, KeyAction::baseline_larger, 1).baseline, 0.1);
  EXPECT_DOUBLE_EQ(pressed(stereo, KeyAction::convergence_nearer, 1).convergence, 30.0);
}

TEST(StereoControls, GoBackToAllThatTheShowHas) {
  StereoSettings stereo = {StereoLayout::rows, StereoModel::physical, 0.1};
  for (const KeyAction key : {KeyAction::swap_eyes, KeyAction::tint_eyes, KeyAction::next_layout, KeyAction::next_model,
                              KeyAction::convergence_nearer}) {
    stereo = pressed(stereo, key, 1);
  }
  EXPECT_EQ(pressed(stereo, KeyAction::baseline_reset, 1),
            (StereoSettings{StereoLayout::rows, StereoModel::physical, 0.1}));
}

TEST(StereoControls, LayoutsComeRoundAndEachIsForAWindow) {
  std::set<StereoLayout> seen;
  StereoSettings stereo;
  for (int i = 0; i < 8; ++i) {
    seen.insert(stereo.layout);
    stereo = pressed(stereo, KeyAction::next_layout, 1);
  }
  EXPECT_EQ(seen.size(), 8U);
  EXPECT_EQ(stereo.layout, StereoLayout::mono);
  EXPECT_FALSE(seen.contains(StereoLayout::separate));
}

TEST(DisparityCaption, HasNoZeroWithAMinus) {
  const StereoSettings stereo = {StereoLayout::rows, StereoModel::physical, 0.1};
  Disparity disparity{};
  disparity.min_px = -0.04;
  disparity.max_px = 0.06;
  EXPECT_THAT(disparity_caption(stereo, disparity), testing::HasSubstr("disparity +0.0 to +0.1 px"));
}

TEST(DisparityCaption, IsInGermanToo) {
  const StereoSettings stereo = {StereoLayout::rows, StereoModel::physical, 0.1};
  EXPECT_THAT(disparity_caption(stereo, Disparity{}, "de"),
              testing::HasSubstr("Basis 0.1 M, Konvergenz unendlich\nDisparität +0.0 bis +0.0 px"));
}

TEST(StereoControls, SwappingTwiceIsNothing) {
  const StereoSettings stereo = {StereoLayout::rows, StereoModel::physical, 0.1};
  EXPECT_TRUE(pressed(stereo, KeyAction::swap_eyes, 1).swap_eyes);
  EXPECT_EQ(pressed(stereo, KeyAction::swap_eyes, 2), stereo);
  EXPECT_EQ(pressed(stereo, KeyAction::pause, 1), stereo);
}

}  // namespace
}  // namespace ergodome
