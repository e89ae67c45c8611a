#include "render/passes/effects/diffraction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/angles.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

ApertureSettings aperture(int blades, int vanes = 0, double obstruction = 0.0, double scale = 1.0) {
  ApertureSettings settings;
  settings.blades = blades;
  settings.vanes = vanes;
  settings.obstruction = obstruction;
  settings.scale = scale;
  return settings;
}

double value(const DiffractionPattern& pattern, int x, int y, int channel) {
  return static_cast<double>(
      pattern.rgb[3U * static_cast<std::size_t>(y * pattern.size_px + x) + static_cast<std::size_t>(channel)]);
}

double energy(const DiffractionPattern& pattern, int channel) {
  double sum = 0.0;
  for (std::size_t i = static_cast<std::size_t>(channel); i < pattern.rgb.size(); i += 3) {
    sum += static_cast<double>(pattern.rgb[i]);
  }
  return sum;
}

//! Returns, for each of 360 directions from the middle of the pattern, the green light along this
//! direction between 20 and 60 px from the middle.
std::vector<double> light_by_direction(const DiffractionPattern& pattern) {
  std::vector<double> light(360);
  const double middle = 0.5 * (pattern.size_px - 1);
  for (int degree = 0; degree < 360; ++degree) {
    for (double r = 20.0; r < 60.0; r += 0.25) {
      const int x = static_cast<int>(std::lround(middle + r * std::cos(degree * pi / 180.0)));
      const int y = static_cast<int>(std::lround(middle - r * std::sin(degree * pi / 180.0)));
      light[static_cast<std::size_t>(degree)] += value(pattern, x, y, 1);
    }
  }
  return light;
}

//! Returns the directions of spikes [degrees, counterclockwise from the right]: the middles of
//! ranges of directions whose light is more than a third of the maximum.
std::vector<double> spikes(const DiffractionPattern& pattern) {
  const std::vector<double> light = light_by_direction(pattern);
  const double bright = *std::max_element(light.begin(), light.end()) / 3.0;
  const auto is_bright = [&](int degree) { return light[static_cast<std::size_t>((degree + 360) % 360)] > bright; };
  std::vector<double> middles;
  for (int degree = 0; degree < 360; ++degree) {
    if (is_bright(degree) && !is_bright(degree - 1)) {
      int end = degree;
      while (is_bright(end + 1) && end < degree + 360) {
        ++end;
      }
      middles.push_back(0.5 * (degree + end));
    }
  }
  return middles;
}

//! Returns the mean light per px² in a pixel whose center is (dx, dy) away from the center of the
//! pattern [px].
double brightness(const FarField& field, double dx, double dy, double wavelength_nm) {
  const auto before = [&](double x, double y) { return field.light_before(x, y, wavelength_nm); };
  return before(dx + 0.5, dy + 0.5) - before(dx - 0.5, dy + 0.5) - before(dx + 0.5, dy - 0.5) +
         before(dx - 0.5, dy - 0.5);
}

TEST(DiffractionPattern, HasAnEnergyOfOneInEachChannel) {
  for (const ApertureSettings& settings : {aperture(6), aperture(0, 4, 0.3)}) {
    const DiffractionPattern pattern = diffraction_pattern(settings);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(energy(pattern, c), 1.0, 1e-5) << c;
    }
  }
}

TEST(DiffractionPattern, IsNowhereNegative) {
  for (const float part : diffraction_pattern(aperture(0)).rgb) {
    ASSERT_GE(part, 0.0F);
  }
}

TEST(FarField, OfARoundApertureIsAirysPattern) {
  constexpr double scale = 8.0;
  const FarField field(aperture(0, 0, 0.0, scale));
  for (const double wavelength_nm : {450.0, 550.0, 650.0}) {
    // The unit of r, which is the wavelength divided by the diameter of the aperture, in pixels.
    const double unit = 2.0 * scale / 1.2196698912665045 * wavelength_nm / 550.0;
    for (const double r : {0.0, 0.3, 0.6, 0.9, 1.4, 1.635, 2.0, 2.4, 2.679, 3.699}) {
      const double v = pi * r;
      const double amplitude = v > 0.0 ? 2.0 * std::cyl_bessel_j(1.0, v) / v : 1.0;
      const double expected = pi / 4.0 / (unit * unit) * amplitude * amplitude;
      for (const double angle : {0.0, 0.5}) {
        const double found = brightness(field, unit * r * std::cos(angle), unit * r * std::sin(angle), wavelength_nm);
        EXPECT_NEAR(found / expected, 1.0, 0.03) << wavelength_nm << " nm, " << r << " wavelengths over the diameter";
      }
    }
  }
}

TEST(FarField, OfARoundApertureHasItsFirstDarkRingWhereTheScaleSays) {
  for (const double scale : {2.0, 4.0, 8.0}) {
    const FarField field(aperture(0, 0, 0.0, scale));
    double darkest = 0.0;
    for (double r = 0.5 * scale; r < 3.0 * scale; r += 0.01) {
      if (darkest == 0.0 || brightness(field, r, 0.0, 550.0) < brightness(field, darkest, 0.0, 550.0)) {
        darkest = r;
      }
    }
    EXPECT_NEAR(darkest / (2.0 * scale), 1.0, 0.04) << scale;
  }
}

TEST(FarField, HoldsAllLightAtAnyWavelength) {
  const FarField field(aperture(6));
  for (const double wavelength_nm : {400.0, 700.0}) {
    EXPECT_NEAR(field.light_before(1e6, 1e6, wavelength_nm), 1.0, 1e-12);
    EXPECT_EQ(field.light_before(-1e6, 1e6, wavelength_nm), 0.0);
  }
}

TEST(DiffractionPattern, OfSixBladesHasSixSpikesOneOfThemUpwards) {
  EXPECT_THAT(spikes(diffraction_pattern(aperture(6))),
              testing::Pointwise(testing::DoubleNear(1.5), {30.0, 90.0, 150.0, 210.0, 270.0, 330.0}));
}

TEST(DiffractionPattern, OfFiveBladesHasTenSpikes) { EXPECT_EQ(spikes(diffraction_pattern(aperture(5))).size(), 10U); }

TEST(DiffractionPattern, OfFourVanesHasFourSpikes) {
  EXPECT_EQ(spikes(diffraction_pattern(aperture(0, 4, 0.2))).size(), 4U);
}

TEST(DiffractionPattern, OfThreeVanesHasSixSpikes) {
  EXPECT_EQ(spikes(diffraction_pattern(aperture(0, 3, 0.2))).size(), 6U);
}

TEST(DiffractionPattern, OfARoundApertureHasNoSpikes) {
  const std::vector<double> light = light_by_direction(diffraction_pattern(aperture(0)));
  EXPECT_LT(*std::max_element(light.begin(), light.end()), 1.4 * *std::min_element(light.begin(), light.end()));
}

TEST(DiffractionPattern, HasTheSymmetryOfItsBlades) {
  // The aperture has six blades, so directions 60 degrees apart are equal, except for the effect of
  // square pixels.
  const std::vector<double> light = light_by_direction(diffraction_pattern(aperture(6)));
  double all = 0.0;
  double sixth = 0.0;
  for (std::size_t degree = 0; degree < 360; ++degree) {
    all += light[degree];
    sixth += std::abs(light[degree] - light[(degree + 60) % 360]);
  }
  EXPECT_LT(sixth / all, 0.05);
}

TEST(DiffractionPattern, SpreadsRedWiderThanBlue) {
  const DiffractionPattern pattern = diffraction_pattern(aperture(0));
  // The total light is the same in each color, so a wider pattern is darker in the middle.
  EXPECT_GT(value(pattern, 64, 64, 1), 1.2 * value(pattern, 64, 64, 0));
  EXPECT_GT(value(pattern, 64, 64, 2), 1.2 * value(pattern, 64, 64, 1));
}

TEST(DiffractionPattern, RefusesAperturesThatDoNotExist) {
  const auto problem_of = [](const ApertureSettings& settings) {
    return test::error_of([&] { diffraction_pattern(settings); });
  };
  EXPECT_THAT(problem_of(aperture(2)), HasSubstr("2 blades"));
  EXPECT_THAT(problem_of(aperture(6, -1)), HasSubstr("-1 vanes"));
  EXPECT_THAT(problem_of(aperture(6, 0, 1.0)), HasSubstr("obstruction"));
  EXPECT_THAT(problem_of(aperture(6, 0, 0.0, std::numeric_limits<double>::quiet_NaN())), HasSubstr("scale"));
  ApertureSettings even;
  even.size_px = 64;
  EXPECT_THAT(problem_of(even), HasSubstr("64 px"));
}

}  // namespace
}  // namespace ergodome
