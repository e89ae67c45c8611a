#include "render/passes/sky/temperature_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/sky/blackbody.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {
namespace {

//! Returns the color of a blackbody at luminance 1. Channels may be negative, outside the gamut of
//! displays.
glm::vec3 colour_of(double temperature_k) {
  const Vector3<double> xyz = blackbody_tristimulus(temperature_k);
  const Vector3<double> rgb = linear_srgb(Vector3<double>{xyz.x / xyz.y, 1.0, xyz.z / xyz.y});
  return {static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z)};
}

TEST(TemperatureFit, BlackbodiesGetTheirOwnTemperature) {
  const TemperatureFit fit(BlackbodyColours(Backend::cpu).view());
  for (double temperature_k = 1600.0; temperature_k < 39'000.0; temperature_k *= 1.07) {
    const double fitted = std::exp(static_cast<double>(fit.log_temperature(7.0F * colour_of(temperature_k))));
    EXPECT_NEAR(fitted / temperature_k, 1.0, temperature_k < 10'000.0 ? 5e-4 : 2e-3) << temperature_k;
  }
}

TEST(TemperatureFit, IlluminantsHaveTheirPublishedTemperatures) {
  const TemperatureFit fit(BlackbodyColours(Backend::cpu).view());
  // The white of sRGB is D65, with a correlated temperature of 6504 K. It is about 0.003 off the
  // Planckian locus in the (u, v) chromaticities of CIE 1960; the approximation of the color
  // matching functions adds to that.
  EXPECT_NEAR(std::exp(fit.log_temperature(glm::vec3(1.0F))), 6504.0F, 60.0F);
  // The illuminant D50 has a correlated temperature of 5003 K.
  const Vector3<float> d50 = linear_srgb(Vector3<float>{0.9642F, 1.0F, 0.8251F});
  EXPECT_NEAR(std::exp(fit.log_temperature({d50.x, d50.y, d50.z})), 5003.0F, 50.0F);
}

TEST(TemperatureFit, ColoursFarOffStayWithinItsLimits) {
  const TemperatureFit fit(BlackbodyColours(Backend::cpu).view());
  const float coldest = std::log(static_cast<float>(TemperatureFit::coldest_k));
  const float hottest = std::log(static_cast<float>(TemperatureFit::hottest_k));
  for (const glm::vec3& rgb : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 1),
                               glm::vec3(0, 1, 1), glm::vec3(1e30F, 0, 0), glm::vec3(0), glm::vec3(1e-40F, 0, 0)}) {
    const float fitted = fit.log_temperature(rgb);
    EXPECT_GE(fitted, coldest - 0.01F);
    EXPECT_LE(fitted, hottest + 0.01F);
  }
  EXPECT_NEAR(fit.log_temperature({1.0F, 0.0F, 0.0F}), coldest, 0.01F);
  EXPECT_NEAR(fit.log_temperature({0.0F, 0.0F, 1.0F}), hottest, 0.01F);
  EXPECT_EQ(fit.weighted_log_temperature(glm::vec3(0.0F)), 0.0F);
  EXPECT_NEAR(lowest_log_temperature, coldest, 1e-5F);
  EXPECT_NEAR(highest_log_temperature, hottest, 1e-5F);
}

TEST(ShiftedLight, WithoutAShiftIsTheLightItself) {
  const BlackbodyColours colours(Backend::cpu);
  for (const Vector3<float>& rgb : {Vector3<float>{1, 1, 1}, {0.2F, 0.5F, 0.1F}, {3.0F, 0.0F, 0.0F}, {0, 0, 5e-6F}}) {
    const Vector3<float> same = shifted_light(colours.view(), rgb, 8.5F, 1.0F);
    EXPECT_NEAR(same.x, rgb.x, 2e-6F * luminance_of(rgb) + 1e-6F * rgb.x);
    EXPECT_NEAR(same.y, rgb.y, 2e-6F * luminance_of(rgb) + 1e-6F * rgb.y);
    EXPECT_NEAR(same.z, rgb.z, 2e-6F * luminance_of(rgb) + 1e-6F * rgb.z);
  }
}

TEST(ShiftedLight, LuminanceGoesAsTheBlackbodysWhateverTheColour) {
  const BlackbodyColours colours(Backend::cpu);
  for (const Vector3<float>& rgb : {Vector3<float>{1, 1, 1}, {0.1F, 0.9F, 0.3F}, {1.0F, 0.2F, 0.9F}}) {
    for (const double g : {0.3, 0.8, 1.7, 3.0}) {
      const Vector3<float> light = shifted_light(colours.view(), rgb, std::log(5000.0F), static_cast<float>(g));
      const double exact = blackbody_tristimulus(g * 5000.0).y / blackbody_tristimulus(5000.0).y;
      EXPECT_NEAR(static_cast<double>(luminance_of(light) / luminance_of(rgb)) / exact, 1.0, 2e-3);
      EXPECT_GE(std::min({light.x, light.y, light.z}), -1e-5F * luminance_of(light));
    }
  }
}

TEST(ShiftedLight, ExtremeShiftsStayNumbers) {
  const BlackbodyColours colours(Backend::cpu);
  for (const float g : {0.0F, 1e-20F, 1e-3F, 1e3F, 1e20F}) {
    const Vector3<float> light = shifted_light(colours.view(), {0.3F, 0.5F, 0.1F}, 8.0F, g);
    EXPECT_TRUE(std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z)) << g;
  }
}

}  // namespace
}  // namespace ergodome
