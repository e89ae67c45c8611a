#include "render/passes/effects/bloom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ergodome {
namespace {

Picture uniform_picture(int width, int height, float value) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.rgba.assign(4 * static_cast<std::size_t>(width * height), value);
  return picture;
}

float& pixel(Picture& picture, int x, int y, int channel) {
  return picture.rgba[4U * static_cast<std::size_t>(y * picture.width + x) + static_cast<std::size_t>(channel)];
}

//! Returns a black picture in which one pixel has the value 1000 in all channels, including
//! coverage.
Picture point(int width, int height, int x, int y) {
  Picture picture = uniform_picture(width, height, 0.0F);
  for (int c = 0; c < 4; ++c) {
    pixel(picture, x, y, c) = 1000.0F;
  }
  return picture;
}

//! Returns a moment of the picture's light: the sum of (x - middle_x)^power times the green
//! channel.
double moment(Picture& picture, double middle_x, int power) {
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      sum += std::pow(x - middle_x, power) * static_cast<double>(pixel(picture, x, y, 1));
    }
  }
  return sum;
}

TEST(Bloom, KeepsTheLightOfAPoint) {
  for (const double radius_px : {1.0, 5.0, 20.0, 40.0}) {
    for (const int size : {512, 517}) {
      Picture picture = point(size, size, 251, 260);
      add_bloom(picture, {0.3, radius_px});
      EXPECT_NEAR(moment(picture, 0.0, 0) / 1000.0, 1.0, 0.01) << radius_px << " " << size;
    }
  }
}

TEST(Bloom, LosesNoLightAtTheBorderOfAnEvenPicture) {
  Picture picture = point(256, 256, 0, 100);
  add_bloom(picture, {1.0, 20.0});
  EXPECT_NEAR(moment(picture, 0.0, 0) / 1000.0, 1.0, 1e-4);
}

TEST(Bloom, LeavesAUniformPictureAsItIs) {
  for (const auto& [width, height] : {std::pair{300, 200}, {301, 199}, {1, 7}, {2, 1}, {3, 3}}) {
    Picture picture = uniform_picture(width, height, 0.7F);
    add_bloom(picture, {1.0, 30.0});
    for (const float value : picture.rgba) {
      ASSERT_NEAR(value, 0.7F, 1e-5F) << width << " x " << height;
    }
  }
}

TEST(Bloom, OfStrengthOrRadiusZeroChangesNothing) {
  const Picture before = point(65, 33, 20, 20);
  for (const BloomSettings& settings : {BloomSettings{0.0, 40.0}, BloomSettings{0.1, 0.0}}) {
    Picture picture = before;
    add_bloom(picture, settings);
    EXPECT_EQ(picture.rgba, before.rgba);
  }
}

TEST(Bloom, TakesItsStrengthFromThePoint) {
  Picture picture = point(512, 512, 256, 256);
  add_bloom(picture, {0.25, 60.0});
  EXPECT_NEAR(pixel(picture, 256, 256, 0), 750.0, 10.0);
}

TEST(Bloom, LeavesTheCoverage) {
  Picture picture = point(64, 64, 30, 30);
  add_bloom(picture, {0.5, 10.0});
  EXPECT_EQ(pixel(picture, 30, 30, 3), 1000.0F);
  EXPECT_EQ(pixel(picture, 31, 30, 3), 0.0F);
}

TEST(Bloom, IsSymmetricAboutThePoint) {
  // The light is a square of 2 x 2 pixels in the middle of a picture, whose size is a power of two.
  // Therefore, the grids of the mip chain are symmetric about it, too.
  Picture picture = point(256, 256, 127, 127);
  for (const auto& [x, y] : {std::pair{128, 127}, {127, 128}, {128, 128}}) {
    pixel(picture, x, y, 1) = 1000.0F;
  }
  add_bloom(picture, {0.5, 12.0});
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const float value = pixel(picture, x, y, 1);
      ASSERT_NEAR(pixel(picture, 255 - x, y, 1), value, 1e-4F * value);
      ASSERT_NEAR(pixel(picture, y, x, 1), value, 1e-4F * value);
    }
  }
}

TEST(Bloom, StaysCentredOnThePointWhereverItLies) {
  for (int x = 250; x < 258; ++x) {
    Picture picture = point(512, 512, x, 256);
    add_bloom(picture, {1.0, 10.0});
    EXPECT_NEAR(moment(picture, x, 1) / 1000.0, 0.0, 0.01) << x;
  }
}

TEST(Bloom, HasTheRadiusThatWasAskedFor) {
  for (const double radius_px : {0.5, 2.0, 3.0, 7.7, 20.0}) {
    Picture picture = point(1024, 1024, 511, 400);
    add_bloom(picture, {1.0, radius_px});
    EXPECT_NEAR(std::sqrt(moment(picture, 511.0, 2) / 1000.0) / radius_px, 1.0, 0.01) << radius_px;
  }
}

TEST(Bloom, DoesNotSpreadWhatIsNotFinite) {
  Picture picture = uniform_picture(101, 67, 1.0F);
  pixel(picture, 50, 30, 0) = std::numeric_limits<float>::quiet_NaN();
  pixel(picture, 20, 30, 0) = std::numeric_limits<float>::infinity();
  add_bloom(picture, {0.5, 10.0});
  int unsound = 0;
  for (const float value : picture.rgba) {
    unsound += std::isfinite(value) && value <= 1.001F ? 0 : 1;
  }
  EXPECT_EQ(unsound, 2);
}

TEST(Bloom, OfOnePixelIsThatPixel) {
  Picture picture = point(1, 1, 0, 0);
  add_bloom(picture, {0.5, 40.0});
  EXPECT_EQ(pixel(picture, 0, 0, 0), 1000.0F);
}

TEST(Bloom, OfAnEmptyPictureIsEmpty) {
  Picture picture;
  add_bloom(picture, {});
  EXPECT_TRUE(picture.rgba.empty());
}

TEST(Bloom, OfAnySizeStaysFiniteAndPositive) {
  for (int width = 1; width < 20; ++width) {
    for (int height = 1; height < 20; height += 3) {
      Picture picture = point(width, height, width / 2, height - 1);
      add_bloom(picture, {0.5, 1000.0});
      for (const float value : picture.rgba) {
        ASSERT_TRUE(value >= 0.0F && value <= 1000.0F) << width << " x " << height;
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
