#include "render/patterns/test_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "render/output/tone_map.h"
#include "render/patterns/pattern_position.h"

namespace ergodome {
namespace {

Projection screen(int size_px = 340) { return make_pinhole_projection(size_px, size_px, 0.7); }
Projection dome(int size_px = 512) { return make_dome_projection(size_px, pi, 0.0); }

const float* pattern_light_at(const Picture& picture, int x, int y) {
  return picture.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
}

//! Returns the displayed value of a channel at a position, given as fractions of the picture's
//! width and height.
int value_at(const Picture& picture, double across, double up, int channel = 0) {
  const auto bytes = tone_mapped(picture);
  const int x = static_cast<int>(across * picture.width);
  const int y = static_cast<int>((1.0 - up) * picture.height);
  return bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                    static_cast<std::size_t>(x)) +
               static_cast<std::size_t>(channel)];
}

TEST(TestPatterns, EveryNameIsAPatternOfTheViewsSize) {
  for (const std::string& name : test_pattern_names()) {
    const Picture picture = draw_test_pattern(test_pattern(name), dome(64));
    EXPECT_EQ(picture.width, 64) << name;
    EXPECT_EQ(picture.rgba.size(), 4U * 64 * 64) << name;
  }
}

TEST(TestPatterns, AnUnknownNameIsAnErrorWithTheNamesThatThereAre) {
  try {
    static_cast<void>(test_pattern("chequers"));
    FAIL();
  } catch (const Error& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("checker"));
  }
}

TEST(TestPatterns, AreBlackBesideADomesCircle) {
  for (const std::string& name : test_pattern_names()) {
    const Picture picture = draw_test_pattern(test_pattern(name), dome(64));
    for (int channel = 0; channel < 4; ++channel) {
      EXPECT_EQ(pattern_light_at(picture, 1, 1)[channel], 0.0F) << name;
    }
  }
}

TEST(TestPatterns, GreyStepsHaveTheDisplaysValues) {
  const Picture picture = draw_test_pattern(TestPattern::grey_ramp, screen());
  for (int step = 0; step < 17; ++step) {
    const double across = 0.1 + 0.8 * (step + 0.5) / 17.0;
    EXPECT_EQ(value_at(picture, across, 0.2), std::min(16 * step, 255)) << step;
    EXPECT_EQ(value_at(picture, across, 0.58), step);
    EXPECT_EQ(value_at(picture, across, 0.8), 239 + step);
  }
}

TEST(TestPatterns, GreyStepsEndAtTheHorizonOfATiltedDome) {
  // The dome is tilted by 25°, so its front extends to 25° below the horizon.
  const Projection tilted = make_dome_projection(256, pi, 25.0 * pi / 180.0);
  const Picture picture = draw_test_pattern(TestPattern::grey_ramp, tilted);
  int lit = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double elevation_deg = pattern_position(tilted, x + 0.5, y + 0.5).elevation_deg;
      const bool light = pattern_light_at(picture, x, y)[0] > 0.0F;
      lit += light ? 1 : 0;
      EXPECT_FALSE(light && elevation_deg < -1.0) << x << ' ' << y;
    }
  }
  EXPECT_GT(lit, 1000);
}

TEST(TestPatterns, ColourBarsFallInLuminanceFromWhiteToBlack) {
  const Picture picture = draw_test_pattern(TestPattern::colour_bars, screen());
  double last = 2.0;
  for (int bar = 0; bar < 8; ++bar) {
    const float* rgb = pattern_light_at(picture, static_cast<int>((bar + 0.5) / 8.0 * picture.width), 10);
    const double luminance = 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                             0.0722 * static_cast<double>(rgb[2]);
    EXPECT_LT(luminance, last) << bar;
    last = luminance;
  }
  EXPECT_EQ(last, 0.0);
}

TEST(TestPatterns, LowerColourBarsAreThreeQuartersOfTheDisplaysValues) {
  const Picture picture = draw_test_pattern(TestPattern::colour_bars, screen());
  EXPECT_EQ(value_at(picture, 0.5 / 8.0, 0.2), 191);
  EXPECT_EQ(value_at(picture, 1.5 / 8.0, 0.2, 2), 0);
}

TEST(TestPatterns, ADomeHasColourBarsFourTimesRound) {
  const Projection whole = make_equirectangular_projection(1024, 512);
  const Picture picture = draw_test_pattern(TestPattern::colour_bars, whole);
  for (int x = 8; x < 250; x += 16) {
    for (int quarter = 1; quarter < 4; ++quarter) {
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_EQ(pattern_light_at(picture, x, 200)[channel],
                  pattern_light_at(picture, x + 256 * quarter, 200)[channel])
            << x;
      }
    }
  }
}

TEST(TestPatterns, FieldsOfTheCheckerAreTenDegreesHigh) {
  const Picture picture = draw_test_pattern(TestPattern::checker, make_equirectangular_projection(720, 360));
  // A pixel is half a degree wide. The rings next to the horizon have 36 fields each.
  for (int field = 0; field < 35; ++field) {
    const float here = pattern_light_at(picture, 20 * field + 10, 170)[0];
    EXPECT_EQ(here + pattern_light_at(picture, 20 * (field + 1) + 10, 170)[0], 1.0F) << field;
    EXPECT_EQ(here + pattern_light_at(picture, 20 * field + 10, 190)[0], 1.0F) << field;
  }
}

TEST(TestPatterns, HalfOfEveryRingOfTheCheckerIsWhite) {
  const Picture picture = draw_test_pattern(TestPattern::checker, make_equirectangular_projection(720, 360));
  for (int y = 10; y < 360; y += 20) {
    double sum = 0.0;
    for (int x = 0; x < 720; ++x) {
      sum += static_cast<double>(pattern_light_at(picture, x, y)[0]);
    }
    EXPECT_NEAR(sum / 720.0, 0.5, 1e-3) << y;
  }
}

TEST(TestPatterns, CirclesOfThePolarGridAreWhereTheirElevationIs) {
  const Picture picture = draw_test_pattern(TestPattern::polar_grid, dome(901));
  // In the equidistant picture, a degree is 5 px; the back is at the top. Tests points on a
  // meridian next to the column of numbers.
  for (const int elevation : {30, 60}) {
    const double radius_px = (90 - elevation) * 5.0;
    const double azimuth = 165.7 * pi / 180.0;
    const int x = static_cast<int>(450.5 + radius_px * std::sin(azimuth));
    const int y = static_cast<int>(450.5 + radius_px * std::cos(azimuth));
    EXPECT_GT(pattern_light_at(picture, x, y)[0], 0.3F) << elevation;
    EXPECT_LT(pattern_light_at(picture, x, y - 5)[0], 0.05F) << elevation;
  }
}

TEST(TestPatterns, LinesOfResolutionAreSinglePixels) {
  const Picture picture = draw_test_pattern(TestPattern::resolution, dome(1024));
  // The patch in the middle is 85 px wide. Its upper left part has vertical lines.
  const int left = 512 - 40;
  for (int i = 0; i < 8; ++i) {
    const float here = pattern_light_at(picture, left + i, 512 - 38)[0];
    EXPECT_TRUE(here == 0.0F || here == 1.0F);
    EXPECT_EQ(here + pattern_light_at(picture, left + i + 1, 512 - 38)[0], 1.0F) << i;
  }
}

TEST(TestPatterns, AnEvenFieldWithoutLinesIsBetweenThemInTheBlendCheck) {
  const Picture picture = draw_test_pattern(TestPattern::blend_check, dome(901));
  const double azimuth = 185.0 * pi / 180.0;
  for (const double from_zenith_deg : {35.0, 45.0, 55.0}) {
    const int x = static_cast<int>(450.5 + 5.0 * from_zenith_deg * std::sin(azimuth));
    const int y = static_cast<int>(450.5 + 5.0 * from_zenith_deg * std::cos(azimuth));
    EXPECT_NEAR(pattern_light_at(picture, x, y)[0], 0.2158F, 1e-3F);
  }
}

//! Returns whether, in any pixel, channel `strong` is much brighter than channel `weak`.
bool has_colour(const Picture& picture, int strong, int weak) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    if (picture.rgba[i + static_cast<std::size_t>(strong)] > picture.rgba[i + static_cast<std::size_t>(weak)] + 0.4F) {
      return true;
    }
  }
  return false;
}

TEST(TestPatterns, EachEyeReadsItsOwnWords) {
  for (const Projection& projection : {dome(), screen()}) {
    const Picture left = draw_test_pattern(TestPattern::left_right, projection, FramePart::left);
    const Picture right = draw_test_pattern(TestPattern::left_right, projection, FramePart::right);
    EXPECT_TRUE(has_colour(left, 0, 2));
    EXPECT_FALSE(has_colour(left, 2, 0));
    EXPECT_TRUE(has_colour(right, 2, 0));
    EXPECT_FALSE(has_colour(right, 0, 2));
  }
}

TEST(TestPatterns, AnotherPatternIsTheSameForBothEyes) {
  const Picture left = draw_test_pattern(TestPattern::checker, dome(64), FramePart::left);
  EXPECT_EQ(left.rgba, draw_test_pattern(TestPattern::checker, dome(64), FramePart::right).rgba);
}

TEST(ProjectorNumber, HasAFrameOfSinglePixelsAlongItsEdge) {
  const Picture picture = draw_projector_number(3, "north", 320, 200);
  for (int x = 0; x < 320; ++x) {
    EXPECT_EQ(pattern_light_at(picture, x, 0)[0], 1.0F);
    EXPECT_EQ(pattern_light_at(picture, x, 199)[0], 1.0F);
  }
  EXPECT_LT(pattern_light_at(picture, 160, 1)[0], 0.1F);
  EXPECT_LT(pattern_light_at(picture, 160, 198)[0], 0.1F);
  EXPECT_EQ(pattern_light_at(picture, 0, 100)[0], 1.0F);
  EXPECT_EQ(pattern_light_at(picture, 319, 100)[0], 1.0F);
}

TEST(ProjectorNumber, DependsOnTheNumber) {
  EXPECT_NE(draw_projector_number(1, "a", 320, 200).rgba, draw_projector_number(2, "a", 320, 200).rgba);
}

TEST(ProjectorNumber, FitsTheSmallestRasterAndRefusesNone) {
  EXPECT_EQ(draw_projector_number(1, "a", 1, 1).rgba.size(), 4U);
  EXPECT_THROW(draw_projector_number(1, "a", 0, 10), Error);
  EXPECT_THROW(draw_projector_number(1, "a", 10, 1 << 20), Error);
}

}  // namespace
}  // namespace ergodome
