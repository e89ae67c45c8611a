#include "render/output/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ergodome {
namespace {

Picture grey(float light, float coverage = 1.0F) {
  Picture picture;
  picture.width = 2;
  picture.height = 1;
  picture.rgba = {light, light, light, coverage, light, light, light, coverage};
  return picture;
}

double middle_light(const Picture& picture) {
  LightMeter meter;
  meter.add(picture);
  return meter.middle_light();
}

class EveryToneCurve : public testing::TestWithParam<ToneCurve> {};

TEST_P(EveryToneCurve, RisesFromBlackAndStaysANumber) {
  const Tone tone{GetParam()};
  EXPECT_NEAR(toned(tone, 0.0F), 0.0F, 1e-6F);
  EXPECT_EQ(toned(tone, -3.0F), toned(tone, 0.0F));
  float before = -1.0F;
  for (float light = 1e-6F; light < 1e4F; light *= 1.3F) {
    const float shown = toned(tone, light);
    EXPECT_GE(shown, before) << light;
    before = shown;
  }
  EXPECT_GT(before, 0.99F);
  for (const float light : {1e30F, std::numeric_limits<float>::max(), std::numeric_limits<float>::infinity()}) {
    EXPECT_GE(toned(tone, light), 0.99F) << light;
  }
}

TEST_P(EveryToneCurve, ExposureIsAFactorOnLight) {
  const Tone once{GetParam()};
  Tone twice = once;
  twice.gain = 2.0F;
  EXPECT_FLOAT_EQ(toned(twice, 0.11F), toned(once, 0.22F));
}

TEST_P(EveryToneCurve, IsUndone) {
  for (const float gain : {0.01F, 1.0F, 100.0F}) {
    const Tone tone{GetParam(), gain};
    for (float display = 0.0F; display < brightest_display_light; display += 0.013F) {
      EXPECT_NEAR(toned(tone, light_for_display(tone, display)), display, 2e-6F) << gain;
    }
    EXPECT_NEAR(toned(tone, light_for_display(tone, 7.0F)), brightest_display_light, 1e-5F);
    EXPECT_NEAR(toned(tone, light_for_display(tone, -1.0F)), 0.0F, 1e-6F);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryToneCurve,
                         testing::Values(ToneCurve::shoulder, ToneCurve::reinhard, ToneCurve::filmic,
                                         ToneCurve::gamma));

TEST(Tone, ReinhardShowsItsWhiteAsWhite) {
  Tone tone{ToneCurve::reinhard};
  tone.white = 7.0F;
  EXPECT_FLOAT_EQ(toned(tone, 7.0F), 1.0F);
}

TEST(Tone, ReinhardHalvesLightOfOneWhenWhiteIsFar) {
  Tone tone{ToneCurve::reinhard};
  tone.white = 1e6F;
  EXPECT_NEAR(toned(tone, 1.0F), 0.5F, 1e-6F);
}

TEST(Tone, FilmicShowsTheValuesOfItsFit) {
  // The formula gives 2.54 / 3.16 for 1.
  EXPECT_NEAR(toned({ToneCurve::filmic}, 1.0F), 2.54F / 3.16F, 1e-6F);
}

TEST(Tone, GammaLiftsDarkLightAndLeavesOne) {
  EXPECT_FLOAT_EQ(toned({ToneCurve::gamma}, 1.0F), 1.0F);
  EXPECT_NEAR(toned({ToneCurve::gamma}, 0.01F), std::pow(0.01, 1.0 / 2.2), 1e-5);
}

TEST(Tone, ShoulderLeavesSkiesAsTheyAre) { EXPECT_EQ(toned({}, 0.7F), 0.7F); }

TEST(LightMeter, TakesTheGeometricMean) {
  Picture picture = grey(0.01F);
  picture.rgba[0] = picture.rgba[1] = picture.rgba[2] = 1.0F;
  EXPECT_NEAR(middle_light(picture), 0.1, 1e-4);
}

TEST(LightMeter, LeavesOutWhatTheSkyDoesNotCover) {
  LightMeter meter;
  meter.add(grey(0.2F));
  meter.add(grey(100.0F, 0.0F));
  EXPECT_NEAR(meter.middle_light(), 0.2, 1e-4);
}

TEST(LightMeter, LeavesOutWhatIsNoNumber) {
  Picture picture = grey(0.2F);
  picture.rgba[0] = std::nanf("");
  picture.rgba[5] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(middle_light(picture), 0.0);
}

TEST(AutoExposure, MeetsItsTargetAtOnceInTheFirstPicture) {
  AutoExposure exposure({0.1, -8.0, 8.0, 2.0});
  EXPECT_NEAR(exposure.follow(0.025, 0.0), 2.0, 1e-9);
}

TEST(AutoExposure, FollowsAChangeByItsTime) {
  AutoExposure exposure({0.1, -8.0, 8.0, 2.0});
  exposure.follow(0.1, 0.0);
  EXPECT_NEAR(exposure.follow(0.2, 2.0), -(1.0 - std::exp(-1.0)), 1e-9);
}

TEST(AutoExposure, DoesNotDependOnTheFrameRate) {
  AutoExposure coarse({0.1, -8.0, 8.0, 2.0});
  AutoExposure fine({0.1, -8.0, 8.0, 2.0});
  coarse.follow(0.1, 0.0);
  fine.follow(0.1, 0.0);
  double stops = 0.0;
  for (int i = 0; i < 100; ++i) {
    stops = fine.follow(0.4, 0.03);
  }
  EXPECT_NEAR(stops, coarse.follow(0.4, 3.0), 1e-9);
}

TEST(AutoExposure, KeepsItsLimits) {
  AutoExposure exposure({0.1, -1.0, 2.0, 0.0});
  EXPECT_EQ(exposure.follow(1e9, 1.0), -1.0);
  EXPECT_EQ(exposure.follow(1e-9, 1.0), 2.0);
}

TEST(AutoExposure, HoldsInTheDark) {
  AutoExposure exposure({0.1, -4.0, 4.0, 0.0});
  const double before = exposure.follow(0.05, 1.0);
  EXPECT_EQ(exposure.follow(0.0, 1.0), before);
}

TEST(AutoExposure, TimeThatGoesBackChangesNothing) {
  AutoExposure exposure({0.1, -4.0, 4.0, 1.0});
  const double before = exposure.follow(0.05, 0.0);
  EXPECT_EQ(exposure.follow(0.4, -100.0), before);
}

}  // namespace
}  // namespace ergodome
