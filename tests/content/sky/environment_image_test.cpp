#include "content/sky/environment_image.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

#include "content/sky/sky_map.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class EnvironmentImageFile : public test::FolderTest {
 protected:
  fs::path write(const std::string& name, int width, int height, int channels, const OIIO::TypeDesc& type,
                 const std::vector<float>& values, bool separate_alpha = false) {
    fs::path path = folder_ / name;
    auto output = OIIO::ImageOutput::create(path.string());
    OIIO::ImageSpec spec(width, height, channels, type);
    if (separate_alpha) {
      spec.alpha_channel = channels - 1;
      spec.attribute("oiio:UnassociatedAlpha", 1);
    }
    EXPECT_TRUE(output->open(path.string(), spec));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    EXPECT_TRUE(output->close());
    return path;
  }

  static std::vector<float> constant(int width, int height, int channels, float value) {
    return std::vector<float>(static_cast<std::size_t>(width * height * channels), value);
  }

  static std::string problem_of(const fs::path& path) {
    return test::error_of([&] { read_environment_image(path); });
  }
};

TEST_F(EnvironmentImageFile, WholeNumbersAreDecodedFromSrgb) {
  for (const char* name : {"map.png", "map.tif"}) {
    const auto image = read_environment_image(write(name, 16, 8, 3, OIIO::TypeDesc::UINT8, constant(16, 8, 3, 0.5F)));
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.height, 8);
    EXPECT_NEAR(image.rgb[0], 0.2159, 0.003) << name;  // sRGB 128 is 21.6 % light
  }
}

TEST_F(EnvironmentImageFile, FloatingPointIsLinear) {
  for (const char* name : {"map.exr", "map.hdr"}) {
    const auto image = read_environment_image(write(name, 16, 8, 3, OIIO::TypeDesc::FLOAT, constant(16, 8, 3, 7.5F)));
    EXPECT_NEAR(image.rgb[5], 7.5, 0.05) << name;
  }
}

TEST_F(EnvironmentImageFile, AGifHasTheLightOfItsGrey) {
  const auto image =
      read_environment_image(write("grey.gif", 16, 8, 3, OIIO::TypeDesc::UINT8, constant(16, 8, 3, 100.0F / 255.0F)));
  EXPECT_THAT(image.rgb, testing::Each(testing::FloatNear(0.1274F, 1e-3F)));  // the sRGB value 100 is 12.74 % light
}

TEST_F(EnvironmentImageFile, AnExrIsPutIntoItsDisplayWindow) {
  // The pixels of the file start at (-2, 3), its display window of 16 x 8 pixels at (1, 1). Pixels
  // to the left of the window are cut off; pixels of the window without data are black.
  OIIO::ImageSpec spec(10, 4, 1, OIIO::TypeDesc::FLOAT);
  spec.x = -2;
  spec.y = 3;
  spec.full_x = 1;
  spec.full_y = 1;
  spec.full_width = 16;
  spec.full_height = 8;
  const fs::path path = folder_ / "window.exr";
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output->open(path.string(), spec));
  std::vector<float> values(40);
  std::iota(values.begin(), values.end(), 1.0F);
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
  const auto image = read_environment_image(path);
  ASSERT_EQ(image.width, 16);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool filled = x < 7 && y >= 2 && y < 6;
      const auto expected = static_cast<float>(filled ? 1 + (y - 2) * 10 + x + 3 : 0);
      EXPECT_EQ(image.rgb[static_cast<std::size_t>(3 * (16 * y + x))], expected) << x << ", " << y;
    }
  }
}

TEST_F(EnvironmentImageFile, AnExrOfAnImmenseWindowIsRefused) {
  OIIO::ImageSpec spec(16, 8, 1, OIIO::TypeDesc::FLOAT);
  spec.full_width = 60'000;
  spec.full_height = 30'000;
  const fs::path path = folder_ / "immense.exr";
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output->open(path.string(), spec));
  const std::vector<float> values(128, 1.0F);
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
  EXPECT_THAT(problem_of(path), HasSubstr("more than 16384 x 8192 pixels"));
}

TEST_F(EnvironmentImageFile, GreyBecomesColourAndLightTimesAlphaStays) {
  const auto grey = read_environment_image(write("grey.exr", 8, 4, 1, OIIO::TypeDesc::HALF, constant(8, 4, 1, 2.0F)));
  EXPECT_EQ(grey.rgb[0], 2.0F);
  EXPECT_EQ(grey.rgb[2], 2.0F);
  std::vector<float> with_alpha = constant(8, 4, 4, 0.25F);
  const auto rgba = read_environment_image(write("rgba.exr", 8, 4, 4, OIIO::TypeDesc::HALF, with_alpha));
  EXPECT_EQ(rgba.rgb.size(), 3U * 8U * 4U);
  EXPECT_EQ(rgba.rgb[0], 0.25F);
}

TEST_F(EnvironmentImageFile, HalfOfAlphaLeavesHalfOfTheLight) {
  for (const int channels : {2, 4}) {
    for (const char* name : {"half.png", "half.tif"}) {
      std::vector<float> values = constant(8, 4, channels, 200.0F / 255.0F);
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = (i + 1) % static_cast<std::size_t>(channels) == 0 ? 128.0F / 255.0F : values[i];
      }
      const auto image = read_environment_image(write(name, 8, 4, channels, OIIO::TypeDesc::UINT8, values, true));
      EXPECT_NEAR(image.rgb[4], 0.5776F * 128.0F / 255.0F, 1e-4F) << name << ", " << channels;  // sRGB 200: 57.76 %
    }
  }
}

TEST_F(EnvironmentImageFile, EightPixelsWideIsEnoughAndFewerAreNot) {
  EXPECT_EQ(read_environment_image(write("8.png", 8, 4, 3, OIIO::TypeDesc::UINT8, constant(8, 4, 3, 1.0F))).width, 8);
  EXPECT_THAT(problem_of(write("6.png", 6, 3, 3, OIIO::TypeDesc::UINT8, constant(6, 3, 3, 1.0F))),
              HasSubstr("6 pixels wide"));
}

TEST_F(EnvironmentImageFile, ThirtyTwoThousandPixelsWideIsAveragedDownToTheRightLight) {
  // Columns alternate between 0 and 1. The mean must be one half everywhere, also where the reader
  // joins blocks of columns. Under sanitizers, a smaller image covers the same code.
  constexpr int width = test::sanitized ? 8192 : 32768;
  OIIO::ImageSpec spec(width, width / 2, 1, OIIO::TypeDesc::HALF);
  spec.attribute("compression", "rle");
  const fs::path path = folder_ / "32k.exr";
  auto output = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(output->open(path.string(), spec));
  constexpr int rows = 256;
  std::vector<std::uint16_t> stripes(static_cast<std::size_t>(width) * rows);
  for (std::size_t i = 0; i < stripes.size(); ++i) {
    stripes[i] = i % 2 == 0 ? 0 : 0x3c00;  // 1 as a half float
  }
  for (int y = 0; y < width / 2; y += rows) {
    ASSERT_TRUE(output->write_scanlines(y, y + rows, 0, OIIO::TypeDesc::HALF, stripes.data()));
  }
  ASSERT_TRUE(output->close());
  const auto image = read_environment_image(path, 1024);
  EXPECT_EQ(image.width, 1024);
  EXPECT_EQ(image.height, 512);
  EXPECT_NEAR(image.rgb[1234], 0.5, 1e-5);
}

TEST_F(EnvironmentImageFile, WiderThanTheLargestIsBroughtDownToIt) {
  // A map of 20 x 10 pixels is reduced to 8 x 4 texels; each texel covers 2.5 by 2.5 pixels.
  std::vector<float> values;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      values.insert(values.end(), {static_cast<float>(x), static_cast<float>(y), 1.0F});
    }
  }
  const auto image = read_environment_image(write("20.exr", 20, 10, 3, OIIO::TypeDesc::FLOAT, values), 8);
  ASSERT_EQ(image.width, 8);
  ASSERT_EQ(image.height, 4);
  EXPECT_EQ(image.file_width, 20);
  for (std::size_t i = 0; i < 32; ++i) {
    // An even texel covers two whole pixels and half of the next one, an odd texel half a pixel and
    // the next two.
    const auto mean = [](std::size_t texel) {
      const double begin = 2.5 * static_cast<double>(texel);
      return texel % 2 == 0 ? 0.2 * (2.0 * begin + 2.0 * (begin + 1.0) + (begin + 2.0))
                            : 0.2 * ((begin - 0.5) + 2.0 * (begin + 0.5) + 2.0 * (begin + 1.5));
    };
    EXPECT_NEAR(image.rgb[3 * i], mean(i % 8), 1e-5);
    EXPECT_NEAR(image.rgb[3 * i + 1], mean(i / 8), 1e-5);
    EXPECT_NEAR(image.rgb[3 * i + 2], 1.0, 1e-6);
  }
}

TEST_F(EnvironmentImageFile, OfAMirroredMapHasTheFirstTexelLast) {
  std::vector<float> values = constant(16, 8, 3, 0.0F);
  values[3 * (2 * 16 + 1)] = 1.0F;  // the second texel of the third row is red
  Show show;
  show.sky.map = write("mirrored.exr", 16, 8, 3, OIIO::TypeDesc::FLOAT, values).string();
  show.sky.map_layout.mirrored = true;
  const EnvironmentImage image = load_sky_map(show);
  std::vector<float> turned = constant(16, 8, 3, 0.0F);
  turned[3 * (2 * 16 + 14)] = 1.0F;
  EXPECT_THAT(image.rgb, testing::ElementsAreArray(turned));
}

TEST_F(EnvironmentImageFile, BrokenTexelsAreRepairedAndCounted) {
  std::vector<float> values = constant(16, 8, 3, 1.0F);
  values[0] = std::numeric_limits<float>::quiet_NaN();
  values[7] = std::numeric_limits<float>::infinity();
  const auto image = read_environment_image(write("nan.exr", 16, 8, 3, OIIO::TypeDesc::FLOAT, values));
  EXPECT_EQ(image.repaired.not_numbers, 1);
  EXPECT_EQ(image.repaired.too_bright, 1);
  EXPECT_TRUE(image.repaired.are_a_mistake());
  for (const float value : image.rgb) {
    EXPECT_TRUE(std::isfinite(value) && value >= 0.0F);
  }
}

TEST_F(EnvironmentImageFile, LightThatIsTooBrightIsAsBrightAsCanBe) {
  std::vector<float> values = constant(16, 8, 3, 1.0F);
  values[3] = 1e30F;
  values[7] = std::numeric_limits<float>::infinity();
  const auto image = read_environment_image(write("bright.exr", 16, 8, 3, OIIO::TypeDesc::FLOAT, values));
  EXPECT_EQ(image.rgb[3], brightest_texel);
  EXPECT_EQ(image.rgb[4], 1.0F);
  EXPECT_EQ(image.rgb[7], infinite_texel);
}

TEST_F(EnvironmentImageFile, ColoursBelowZeroAreNoLightAndTheOthersStay) {
  // Sharpening filters leave negative values next to bright stars.
  std::vector<float> values = constant(16, 8, 3, 1.0F);
  values[10] = -3.0F;
  const auto image = read_environment_image(write("below.exr", 16, 8, 3, OIIO::TypeDesc::FLOAT, values));
  EXPECT_EQ(image.repaired.below_zero, 1);
  EXPECT_FALSE(image.repaired.are_a_mistake());
  EXPECT_EQ(image.rgb[9], 1.0F);
  EXPECT_EQ(image.rgb[10], 0.0F);
  EXPECT_EQ(image.rgb[11], 1.0F);
}

TEST_F(EnvironmentImageFile, WithoutAnySoundTexelIsAnError) {
  EXPECT_THAT(problem_of(write("all-nan.exr", 16, 8, 3, OIIO::TypeDesc::FLOAT,
                               constant(16, 8, 3, std::numeric_limits<float>::quiet_NaN()))),
              HasSubstr("no finite colors"));
}

TEST_F(EnvironmentImageFile, OfAnotherShapeIsAnError) {
  EXPECT_THAT(problem_of(write("square.png", 16, 16, 3, OIIO::TypeDesc::UINT8, constant(16, 16, 3, 1.0F))),
              HasSubstr("neither twice as wide as high nor a cube map"));
}

TEST_F(EnvironmentImageFile, MissingForeignAndTornFilesAreErrorsWithTheirName) {
  EXPECT_THAT(problem_of(folder_ / "absent.exr"), HasSubstr("absent.exr"));
  EXPECT_THAT(problem_of(folder_), HasSubstr("is not a regular file"));
  std::ofstream(folder_ / "text.png") << "this is no picture";
  EXPECT_THAT(problem_of(folder_ / "text.png"), HasSubstr("text.png"));
  const fs::path whole = write("torn.exr", 64, 32, 3, OIIO::TypeDesc::FLOAT, constant(64, 32, 3, 0.3F));
  fs::resize_file(whole, fs::file_size(whole) / 2);
  EXPECT_THAT(problem_of(whole), HasSubstr("torn.exr"));
}

}  // namespace
}  // namespace ergodome
