#include "render/passes/stars/drawing/star_splat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/projection/make_projection.h"
#include "render/passes/stars/drawing/point_spread.h"
#include "tests/render/passes/stars/star_cameras.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Projects star images to the screen and adds their light to rows of a picture.
void splat_stars(const std::vector<StarImage>& images, const EyeCamera& eye, const Projection& projection,
                 const SplatSettings& settings, int first_row, int row_count, float* rgba) {
  splat_points(star_points(images, eye, projection, settings), projection, settings, first_row, row_count, rgba);
}

TEST(StarSplat, LightDoesNotDependOnSpreadNorResolution) {
  const EyeCamera eye = eye_at_position(positions[0]);
  const StarField field(brightest(2000), glm::dmat3(1.0), colours().view());
  // Keeps only star images away from the rim, so that the picture contains all of their light.
  std::vector<StarImage> images = images_of(field, eye, settings_for(9.0));
  std::erase_if(images, [](const StarImage& image) { return image.direction.y > -0.15F; });
  double there = 0.0;
  for (const StarImage& image : images) {
    there += static_cast<double>(image.illuminance.y);
  }
  for (const int size : {256, 700, 1024}) {
    for (const double sigma_px : {0.0, 0.3, 0.5, 2.0}) {
      const Projection projection = make_dome_projection(size, pi, 0.0);
      std::vector<float> rgba(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
      splat_stars(images, eye, projection, {sigma_px, 1.0F}, 0, size, rgba.data());
      EXPECT_NEAR(light_of(rgba, projection) / there, 1.0, 0.01) << size << " " << sigma_px;
    }
  }
}

//! Draws one star in the middle of a dome. Returns the value of the brightest pixel and the number
//! of lit pixels.
std::pair<float, long> spot_of(int size_px, const SplatSettings& settings) {
  const Projection projection = make_dome_projection(size_px, pi, 0.0);
  const std::vector<StarPoint> points = {{0.5 * size_px + 0.5, 0.5 * size_px + 0.5, {1.0F, 1.0F, 1.0F}, {}}};
  std::vector<float> rgba(4 * static_cast<std::size_t>(size_px) * 64);
  splat_points(points, projection, scaled_to(settings, projection), size_px / 2 - 32, 64, rgba.data());
  float brightest = 0.0F;
  long lit = 0;
  for (std::size_t i = 1; i < rgba.size(); i += 4) {
    brightest = std::max(brightest, rgba[i]);
    lit += rgba[i] > 0.0F ? 1 : 0;
  }
  return {brightest, lit};
}

TEST(StarSplat, SpotsKeepTheirAngleInPicturesFinerThan4k) {
  const SplatSettings settings{1.0, 1.0F};
  const auto [of_1k, lit_1k] = spot_of(1024, settings);
  const auto [of_4k, lit_4k] = spot_of(4096, settings);
  const auto [of_8k, lit_8k] = spot_of(8192, settings);
  EXPECT_EQ(lit_1k, 49);
  EXPECT_EQ(lit_4k, 49);
  EXPECT_EQ(lit_8k, 169);
  EXPECT_EQ(of_1k, of_4k);
  // At 8K, the spot of a star is twice as wide in both directions as at 4K. The maximum of the
  // Gaussian is a quarter, except for the effect of the width of pixels.
  EXPECT_NEAR(of_8k / of_4k, 0.25, 0.02);
  EXPECT_EQ(scaled_to(settings, make_pinhole_projection(8192, 4096, 0.1)).sigma_px, 1.0);
}

TEST(StarSplat, WideSpotsAreGaussians) {
  constexpr double sigma_px = 100.0;
  constexpr int size_px = 700;
  const Projection projection = make_pinhole_projection(size_px, size_px, 1.0);
  const std::vector<StarPoint> points = {{350.5, 350.5, {1.0F, 1.0F, 1.0F}, {}}};
  std::vector<float> rgba(4UL * size_px * size_px);
  splat_points(points, projection, {sigma_px, 1.0F}, 0, size_px, rgba.data());
  const auto light = [&](int x, int y) { return rgba[4UL * static_cast<std::size_t>(y * size_px + x) + 1UL]; };
  for (const int off_px : {50, 100, 200, 290}) {
    const double expected = std::exp(-0.5 * std::pow(off_px / sigma_px, 2));
    EXPECT_NEAR(light(350 + off_px, 350) / light(350, 350), expected, 2e-3 * expected + 1e-4) << off_px;
    EXPECT_NEAR(light(350, 350 - off_px) / light(350, 350), expected, 2e-3 * expected + 1e-4) << off_px;
  }
  EXPECT_EQ(light(350 + 302, 350), 0.0F);
}

TEST(StarSplat, SpotsReachNoFartherThanTheyMayInTheFinestPictures) {
  const Projection narrow = make_dome_projection(16384, 0.1, 0.0);
  EXPECT_LE(scaled_to({100.0, 1.0F}, narrow).reach_px(), widest_splat_px);
  EXPECT_GT(scaled_to({100.0, 1.0F}, narrow).reach_px(), 1000.0);
}

TEST(StarSplat, PartsOfPointsAreIntegralsOfTheGaussian) {
  PointSpread spread;
  for (const double sigma_px : {0.01, 0.1, 0.37, 1.0, 7.0, 300.0}) {
    for (const double sigmas : {0.5, 3.0, 3.99}) {
      const double reach = std::min(sigmas * sigma_px, widest_splat_px - 1.0);
      const PointSpreads spreads(sigma_px, reach);
      const double narrower = 1.0 / (sigma_px * std::sqrt(2.0));
      for (int i = 0; i <= 97; ++i) {
        const double middle_px = 40.0 + i / 97.0;
        spreads.spread(middle_px, spread);
        ASSERT_EQ(spread.first, std::floor(middle_px - reach));
        ASSERT_EQ(spread.count, std::floor(middle_px + reach) - spread.first + 1);
        const auto before = [&](int pixel) {
          return std::erf(std::clamp(pixel - middle_px, -reach, reach) * narrower) / std::erf(reach * narrower);
        };
        for (int pixel = 0; pixel < spread.count; ++pixel) {
          const int x = spread.first + pixel;
          EXPECT_NEAR(spread.part.at(static_cast<std::size_t>(pixel)), 0.5 * (before(x + 1) - before(x)), 2e-6)
              << sigma_px << " " << reach << " " << i << " " << pixel;
        }
      }
    }
  }
}

TEST(StarSplat, SpotsEndAtTheirCutOff) {
  SplatSettings settings{0.5, 1.0F};
  settings.cutoff_px = 0.4;
  EXPECT_EQ(spot_of(1024, settings).second, 1);
  settings.cutoff_px = 2.4;
  EXPECT_EQ(spot_of(1024, settings).second, 25);
}

TEST(StarSplat, BlocksOfRowsMakeTheWholePicture) {
  const EyeCamera eye = eye_at_position(positions[1]);
  const StarField field(brightest(2000), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(9.0));
  const Projection projection = make_equirectangular_projection(512, 256);
  std::vector<float> whole(4 * 512 * 256);
  std::vector<float> parts(4 * 512 * 256);
  splat_stars(images, eye, projection, {0.7, 1.0F}, 0, 256, whole.data());
  for (int row = 0; row < 256; row += 51) {
    splat_stars(images, eye, projection, {0.7, 1.0F}, row, std::min(51, 256 - row), parts.data() + 4L * 512 * row);
  }
  EXPECT_EQ(whole, parts);
}

}  // namespace
}  // namespace ergodome
