#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {
namespace {

TEST(Blackbody, PlanckianLocusHasItsPublishedChromaticities) {
  struct Point {
    double temperature_k, x, y;
  };
  // Chromaticities by CIE 1931: illuminant A, and the Planckian locus at 6504 K and 10,000 K. The
  // color matching functions are approximated to about 0.003.
  for (const Point& p : {Point{2856.0, 0.4476, 0.4074}, {6504.0, 0.3135, 0.3237}, {10'000.0, 0.2807, 0.2884}}) {
    const Vector3<double> xyz = blackbody_tristimulus(p.temperature_k);
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, p.x, 3e-3) << p.temperature_k;
    EXPECT_NEAR(xyz.y / sum, p.y, 3e-3) << p.temperature_k;
  }
}

TEST(Blackbody, LuminanceIsThatOfTheCandelasOldDefinition) {
  // Luminance of a blackbody at the freezing point of platinum, 2041.4 K: 60 cd/cm².
  EXPECT_NEAR(blackbody_tristimulus(2041.4).y, 6.0e5, 0.02e5);
}

TEST(Blackbody, ColourIndexGivesTheTemperatureOfTheSun) { EXPECT_NEAR(star_temperature(0.653), 5772.0, 40.0); }

//! Computes the same values as blackbody_tristimulus() by another integration rule: five-point
//! Gauss-Legendre quadrature on intervals of 5 nm.
Vector3<double> independent_tristimulus(double temperature_k) {
  constexpr double at[] = {0.0, 0.53846931010568309, 0.90617984593866399};
  constexpr double weight[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
  Vector3<double> sum = {0.0, 0.0, 0.0};
  for (double left = 360.0; left < 829.0; left += 5.0) {
    for (int i = 0; i < 3; ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double l = left + 2.5 + side * 2.5 * at[i];
        const double w = (i == 0 ? 0.5 : 1.0) * weight[i] * 2.5e-9 * 683.0;
        sum = sum + (w * planck_radiance(1e-9 * l, temperature_k)) * cie_matching(l);
      }
    }
  }
  return sum;
}

TEST(StarLight, IsTheIntegralOfPlanckAndTheMatchingFunctions) {
  const BlackbodyColours colours(Backend::cpu);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 50; ++i) {
    const double temperature_k = std::exp(std::log(2000.0) + uniform(random) * std::log(25.0));
    const double g = std::exp((uniform(random) - 0.5) * 2.0 * std::log(3.0));
    const double magnification = std::exp((uniform(random) - 0.5) * 12.0);
    const double flux = 1e-7 * uniform(random);
    const Vector3<double> seen = independent_tristimulus(g * temperature_k);
    const double scale = magnification * flux / independent_tristimulus(temperature_k).y;
    const Vector3<double> rgb = scale * linear_srgb(seen);
    const Vector3<float> light =
        star_light(colours.view(), static_cast<float>(std::log(temperature_k)), static_cast<float>(flux),
                   static_cast<float>(g), static_cast<float>(magnification));
    const double luminance = scale * seen.y;
    const double made = 0.2126729 * light.x + 0.7151522 * light.y + 0.0721750 * light.z;
    EXPECT_NEAR(made / luminance, 1.0, 5e-3) << temperature_k << " " << g;
    if (std::min({rgb.x, rgb.y, rgb.z}) >= 0.0) {
      EXPECT_NEAR(light.x / luminance, rgb.x / luminance, 5e-3) << temperature_k << " " << g;
      EXPECT_NEAR(light.y / luminance, rgb.y / luminance, 5e-3) << temperature_k << " " << g;
      EXPECT_NEAR(light.z / luminance, rgb.z / luminance, 5e-3) << temperature_k << " " << g;
    }
  }
}

TEST(StarLight, ColoursThatNoDisplayShowsKeepTheirLuminance) {
  const BlackbodyColours colours(Backend::cpu);
  const Vector3<float> ember = star_light(colours.view(), std::log(1000.0F), 1.0F, 1.0F, 1.0F);
  EXPECT_GE(std::min({ember.x, ember.y, ember.z}), -1e-6F);
  EXPECT_NEAR(0.2126729F * ember.x + 0.7151522F * ember.y + 0.0721750F * ember.z, 1.0F, 1e-3F);
}

TEST(StarLight, ExtremeShiftsStayNumbers) {
  const BlackbodyColours colours(Backend::cpu);
  for (const float g : {0.0F, 1e-20F, 1e-3F, 1e3F, 1e20F}) {
    const Vector3<float> light = star_light(colours.view(), std::log(5000.0F), 1e-6F, g, 1.0F);
    EXPECT_TRUE(std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z)) << g;
    EXPECT_GE(light.x, 0.0F);
  }
}

}  // namespace
}  // namespace ergodome
