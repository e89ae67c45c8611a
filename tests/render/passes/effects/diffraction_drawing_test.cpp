#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "render/passes/effects/diffraction.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

double pattern_value(const DiffractionPattern& pattern, int x, int y, int channel) {
  return static_cast<double>(
      pattern.rgb[3U * static_cast<std::size_t>(y * pattern.size_px + x) + static_cast<std::size_t>(channel)]);
}

double sum_of(const std::vector<float>& values, std::size_t channel, std::size_t channels) {
  double sum = 0.0;
  for (std::size_t i = channel; i < values.size(); i += channels) {
    sum += static_cast<double>(values[i]);
  }
  return sum;
}

//! Returns a diffraction pattern of 5 x 5 px without symmetry, whose values add up to 1.
DiffractionPattern small_pattern() {
  DiffractionPattern pattern{5, std::vector<float>(75)};
  for (std::size_t i = 0; i < 75; ++i) {
    const std::size_t pixel = i / 3;
    pattern.rgb[i] = static_cast<float>(pixel + 1) / 325.0F;
  }
  return pattern;
}

struct Sums {
  double red = 0.0;
  double x = 0.0;
  double y = 0.0;
};

//! Returns the sum of the red channel of a picture with four floats per pixel, and the center of
//! this light [px].
Sums sums(const std::vector<float>& rgba, int width) {
  Sums all;
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const int pixel = static_cast<int>(i / 4);
    const int row = pixel / width;
    const double red = static_cast<double>(rgba[i]);
    all.red += red;
    all.x += red * (pixel % width + 0.5);
    all.y += red * (row + 0.5);
  }
  all.x /= all.red;
  all.y /= all.red;
  return all;
}

TEST(AddDiffraction, AddsTheLightOfThePoint) {
  std::vector<float> rgba(4 * 20 * 30);
  add_diffraction(small_pattern(), 10.3, 14.9, {3.0F, 2.0F, 1.0F}, 20, 30, rgba.data());
  EXPECT_NEAR(sum_of(rgba, 0, 4), 3.0, 1e-5);
  EXPECT_NEAR(sum_of(rgba, 1, 4), 2.0, 1e-5);
  EXPECT_NEAR(sum_of(rgba, 2, 4), 1.0, 1e-5);
  EXPECT_EQ(sum_of(rgba, 3, 4), 0.0);
}

TEST(AddDiffraction, InTheMiddleOfAPixelCopiesThePattern) {
  std::vector<float> rgba(4 * 5 * 5);
  add_diffraction(small_pattern(), 2.5, 2.5, {1.0F, 1.0F, 1.0F}, 5, 5, rgba.data());
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_FLOAT_EQ(rgba[4 * i], static_cast<float>(i + 1) / 325.0F);
  }
}

TEST(AddDiffraction, MovesByPartsOfAPixel) {
  const auto centre_at = [](double x_px, double y_px) {
    std::vector<float> rgba(4 * 20 * 20);
    add_diffraction(small_pattern(), x_px, y_px, {1.0F, 1.0F, 1.0F}, 20, 20, rgba.data());
    return sums(rgba, 20);
  };
  const Sums start = centre_at(9.5, 9.5);
  for (const double step : {0.1, 0.5, 0.95, 1.3}) {
    const Sums moved = centre_at(9.5 + step, 9.5 - step);
    EXPECT_NEAR(moved.x - start.x, step, 1e-4);
    EXPECT_NEAR(moved.y - start.y, -step, 1e-4);
  }
}

TEST(AddDiffraction, IsClippedAtTheBorders) {
  // Guard values before and after the rows of the picture must not change. The expected values are
  // computed in a larger picture.
  constexpr int size = 4;
  constexpr int around = 20;
  for (double x = -5.0; x < size + 5.0; x += 0.7) {
    for (double y = -5.0; y < size + 5.0; y += 0.7) {
      std::vector<float> guarded(4 * (size * size + 2 * around));
      std::vector<float> large(4 * (size + 2 * around) * (size + 2 * around));
      add_diffraction(small_pattern(), x, y, {1.0F, 1.0F, 1.0F}, size, size, guarded.data() + 4 * around);
      add_diffraction(small_pattern(), x + around, y + around, {1.0F, 1.0F, 1.0F}, size + 2 * around, size + 2 * around,
                      large.data());
      for (int i = -around; i < size * size + around; ++i) {
        const bool inside = i >= 0 && i < size * size;
        const int there = (i / size + around) * (size + 2 * around) + i % size + around;
        const float expected = inside ? large[4U * static_cast<std::size_t>(there)] : 0.0F;
        ASSERT_NEAR(guarded[static_cast<std::size_t>(4 * (i + around))], expected, 1e-6F) << x << " " << y << " " << i;
      }
    }
  }
}

TEST(AddDiffraction, OfAPlaceThatIsNotFiniteOrFarAwayAddsNothing) {
  std::vector<float> rgba(4 * 8 * 8);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double position : {std::nan(""), infinite, -infinite, 1e30, -1e30}) {
    add_diffraction(small_pattern(), position, 4.0, {1.0F, 1.0F, 1.0F}, 8, 8, rgba.data());
    add_diffraction(small_pattern(), 4.0, position, {1.0F, 1.0F, 1.0F}, 8, 8, rgba.data());
  }
  EXPECT_EQ(rgba, std::vector<float>(4 * 8 * 8));
}

class DiffractionFile : public test::FolderTest {
 protected:
  fs::path write(const std::string& name, int width, int height, int channels, const OIIO::TypeDesc& type,
                 const std::vector<float>& values) {
    fs::path path = folder_ / name;
    auto output = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(output->open(path.string(), OIIO::ImageSpec(width, height, channels, type)));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    EXPECT_TRUE(output->close());
    return path;
  }

  static std::string problem_of(const fs::path& path) {
    return test::error_of([&] { load_diffraction_pattern(path); });
  }
};

TEST_F(DiffractionFile, IsLinearisedAndNormalised) {
  const auto pattern = load_diffraction_pattern(write("grey.png", 3, 1, 1, OIIO::TypeDesc::UINT16, {0.5F, 1.0F, 0.5F}));
  EXPECT_EQ(pattern.size_px, 3);
  // The sRGB value 0.5 is linear light of 0.21404.
  EXPECT_NEAR(pattern_value(pattern, 0, 1, 1), 0.21404 / 1.42808, 1e-4);
  EXPECT_NEAR(pattern_value(pattern, 1, 1, 2), 1.0 / 1.42808, 1e-4);
  EXPECT_NEAR(sum_of(pattern.rgb, 0, 3), 1.0, 1e-6);
}

TEST_F(DiffractionFile, OfEvenSizeKeepsItsMiddleInTheMiddle) {
  const auto pattern =
      load_diffraction_pattern(write("even.exr", 2, 2, 1, OIIO::TypeDesc::FLOAT, {5.0F, 5.0F, 5.0F, 5.0F}));
  EXPECT_EQ(pattern.size_px, 3);
  EXPECT_NEAR(pattern_value(pattern, 1, 1, 0), 0.25, 1e-6);
  EXPECT_NEAR(pattern_value(pattern, 0, 0, 0), 1.0 / 16.0, 1e-6);
  EXPECT_NEAR(pattern_value(pattern, 2, 1, 0), 0.125, 1e-6);
}

TEST_F(DiffractionFile, BlackInAChannelIsAnError) {
  EXPECT_THAT(problem_of(write("black.exr", 3, 3, 3, OIIO::TypeDesc::FLOAT, std::vector<float>(27))),
              HasSubstr("black.exr: has a color channel without light"));
  EXPECT_THAT(problem_of(write("red.exr", 1, 1, 3, OIIO::TypeDesc::FLOAT, {1.0F, 0.0F, 0.0F})),
              HasSubstr("has a color channel without light"));
}

TEST_F(DiffractionFile, NotFiniteIsAnError) {
  EXPECT_THAT(problem_of(write("nan.exr", 2, 1, 1, OIIO::TypeDesc::FLOAT, {1.0F, std::nanf("")})),
              HasSubstr("non-finite values"));
}

TEST_F(DiffractionFile, AsLargeAsAllowedIsReadAndLargerIsAnError) {
  const std::vector<float> row(1026, 1.0F);
  EXPECT_EQ(load_diffraction_pattern(write("w.exr", 1025, 1, 1, OIIO::TypeDesc::FLOAT, row)).size_px, 1025);
  EXPECT_THAT(problem_of(write("wide.exr", 1026, 1, 1, OIIO::TypeDesc::FLOAT, row)), HasSubstr("1026 x 1 pixels"));
}

TEST_F(DiffractionFile, MissingForeignAndTornIsAnErrorWithItsName) {
  EXPECT_THAT(problem_of(folder_ / "absent.exr"), HasSubstr("absent.exr: is not a readable file"));
  std::ofstream(folder_ / "text.png") << "this is no picture";
  EXPECT_THAT(problem_of(folder_ / "text.png"), HasSubstr("text.png: cannot be read as an image"));
  const fs::path torn = write("torn.exr", 64, 64, 3, OIIO::TypeDesc::FLOAT, std::vector<float>(12288, 0.3F));
  fs::resize_file(torn, fs::file_size(torn) / 2);
  EXPECT_THAT(problem_of(torn), HasSubstr("torn.exr"));
}

}  // namespace
}  // namespace ergodome
