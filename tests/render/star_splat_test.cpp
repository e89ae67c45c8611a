#include "render/stars/star_splat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/star_cameras.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Finds the places of images on the screen and adds them to rows of a picture.
void splat_stars(const std::vector<StarImage>& images, const EyeCamera& eye, const Projection& projection,
                 const SplatSettings& settings, int first_row, int row_count, float* rgba) {
  splat_points(star_points(images, eye, projection, settings), projection, settings, first_row, row_count, rgba);
}

TEST(StarSplat, LightDoesNotDependOnSpreadNorResolution) {
  const EyeCamera eye = eye_at(places[0]);
  const StarField field(brightest(2000), glm::dmat3(1.0), colours().view());
  // Away from the rim, so that all of each image is in the picture.
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

TEST(StarSplat, BlocksOfRowsMakeTheWholePicture) {
  const EyeCamera eye = eye_at(places[1]);
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

TEST(Projection, PixelFromDirectionIsTheInverse) {
  for (const Projection& projection : {make_dome_projection(500, pi, 0.5), make_equirectangular_projection(600, 300),
                                       make_pinhole_projection(640, 360, 1.2)}) {
    for (double x = 3.3; x < projection.width_px; x += 41.0) {
      for (double y = 2.1; y < projection.height_px; y += 37.0) {
        double back_x = 0.0;
        double back_y = 0.0;
        ASSERT_TRUE(pixel_from_direction(projection, direction_from_pixel(projection, x, y), back_x, back_y));
        EXPECT_NEAR(back_x, x, 1e-9);
        EXPECT_NEAR(back_y, y, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
