#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tiffio.h>

#include <array>
#include <fstream>
#include <functional>

#include "content/sky/environment_image.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int shown_width = 32;
constexpr int shown_height = 16;

//! Returns the value of the displayed picture at (u, v): a different constant in each quarter.
int shown_number(int u, int v) {
  return v < shown_height / 2 ? (u < shown_width / 2 ? 30 : 90) : (u < shown_width / 2 ? 150 : 220);
}

//! The pixels of the displayed picture in the order in which a file with the given Exif orientation
//! stores them. Exif 2.3, tag 274, defines for each orientation the sides of the picture at which
//! row 0 and column 0 of the file are: 1 top left, 2 top right, 3 bottom right, 4 bottom left, 5
//! left top, 6 right top, 7 right bottom, 8 left bottom.
struct Stored {
  explicit Stored(int orientation)
      : across(orientation >= 5),
        width(across ? shown_height : shown_width),
        height(across ? shown_width : shown_height) {
    const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const int x = across ? row : column;
        const int y = across ? column : row;
        numbers.push_back(shown_number(from_right ? shown_width - 1 - x : x, from_bottom ? shown_height - 1 - y : y));
      }
    }
  }

  bool across;
  int width;
  int height;
  std::vector<int> numbers;
};

class TurnedImages : public test::FolderTest {
 protected:
  fs::path write_tiff(int orientation, int photometric, int compression) {
    const Stored stored(orientation);
    fs::path path = folder_ / fmt::format("{}_{}_{}.tif", photometric, compression, orientation);
    const std::size_t channels = photometric == PHOTOMETRIC_MINISBLACK ? 1 : 3;
    TIFF* const file = TIFFOpen(path.c_str(), "w");
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, stored.width);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, stored.height);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(channels));
    TIFFSetField(file, TIFFTAG_COMPRESSION, compression);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, photometric);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, stored.height);
    TIFFSetField(file, TIFFTAG_ORIENTATION, orientation);
    if (photometric == PHOTOMETRIC_YCBCR) {
      TIFFSetField(file, TIFFTAG_YCBCRSUBSAMPLING, 1, 1);
    }
    const unsigned char grey = photometric == PHOTOMETRIC_YCBCR ? 128 : 0;
    for (int row = 0; row < stored.height; ++row) {
      std::vector<unsigned char> pixels;
      const std::ptrdiff_t first = std::ptrdiff_t{row} * stored.width;
      for (std::ptrdiff_t column = 0; column < stored.width; ++column) {
        pixels.push_back(static_cast<unsigned char>(stored.numbers[static_cast<std::size_t>(first + column)]));
        pixels.resize(static_cast<std::size_t>(column + 1) * channels, grey);
      }
      TIFFWriteScanline(file, pixels.data(), static_cast<std::uint32_t>(row), 0);
    }
    TIFFClose(file);
    return path;
  }

  fs::path write_radiance(const std::string& header, const std::string& size, const std::vector<int>& numbers) {
    fs::path path = folder_ / "map.hdr";
    std::ofstream file(path, std::ios::binary);
    const bool has_format = header.find("FORMAT=") != std::string::npos;
    file << "#?RADIANCE\n" << (has_format ? "" : "FORMAT=32-bit_rle_rgbe\n") << header << "\n" << size << "\n";
    for (const int number : numbers) {
      for (const int byte : {number, number, number, 129}) {
        file.put(static_cast<char>(byte));
      }
    }
    return path;
  }

  //! Returns the values of the red channel in the middle of each quarter of the picture.
  static std::array<float, 4> quarters(const fs::path& path) {
    const EnvironmentImage image = read_environment_image(path);
    EXPECT_EQ(image.width, shown_width);
    EXPECT_EQ(image.height, shown_height);
    const auto at = [&](int u, int v) { return image.rgb.at(static_cast<std::size_t>(v * image.width + u) * 3); };
    return {at(7, 3), at(23, 3), at(7, 11), at(23, 11)};
  }
};

TEST_F(TurnedImages, TiffsAreShownUprightInEveryOrientation) {
  const std::pair<int, int> kinds[] = {
      {PHOTOMETRIC_RGB, COMPRESSION_NONE},        {PHOTOMETRIC_RGB, COMPRESSION_LZW},
      {PHOTOMETRIC_MINISBLACK, COMPRESSION_NONE}, {PHOTOMETRIC_MINISBLACK, COMPRESSION_JPEG},
      {PHOTOMETRIC_YCBCR, COMPRESSION_NONE},      {PHOTOMETRIC_YCBCR, COMPRESSION_JPEG},
      {PHOTOMETRIC_CIELAB, COMPRESSION_NONE}};
  for (const auto& [photometric, compression] : kinds) {
    const std::array<float, 4> upright = quarters(write_tiff(1, photometric, compression));
    EXPECT_LT(upright[0] + 0.05F, upright[1]);
    EXPECT_LT(upright[1] + 0.05F, upright[2]);
    EXPECT_LT(upright[2] + 0.05F, upright[3]);
    for (int orientation = 2; orientation <= 8; ++orientation) {
      EXPECT_THAT(quarters(write_tiff(orientation, photometric, compression)),
                  testing::Pointwise(testing::FloatNear(0.02F), upright))
          << photometric << " " << compression << " orientation " << orientation;
    }
  }
}

TEST_F(TurnedImages, RadiancePicturesAreShownUprightInEveryOrientation) {
  const std::string sizes[] = {"-Y 16 +X 32", "-Y 16 -X 32", "+Y 16 -X 32", "+Y 16 +X 32",
                               "+X 32 -Y 16", "-X 32 -Y 16", "-X 32 +Y 16", "+X 32 +Y 16"};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string& size = sizes[orientation - 1];
    EXPECT_THAT(quarters(write_radiance("", size, Stored(orientation).numbers)),
                testing::Pointwise(testing::FloatNear(0.01F), {30.0F / 128, 90.0F / 128, 150.0F / 128, 220.0F / 128}))
        << size;
  }
}

TEST_F(TurnedImages, TheExposureOfRadiancePicturesIsTakenOut) {
  const std::vector<int> numbers(shown_width * shown_height, 128);
  const EnvironmentImage image =
      read_environment_image(write_radiance("EXPOSURE=4\nEXPOSURE= 0.5\nCOLORCORR=1 2 4\n", "-Y 16 +X 32", numbers));
  EXPECT_NEAR(image.rgb[0], 0.5, 0.01);
  EXPECT_NEAR(image.rgb[1], 0.25, 0.01);
  EXPECT_NEAR(image.rgb[2], 0.125, 0.01);
}

// In Radiance's XYZ files, equal parts of X, Y and Z are white, as in its program ra_xyze. The
// other color is expected to follow from Bradford's adaptation from illuminant E to D65 and the
// sRGB matrix published by Lindbloom (brucelindbloom.com).
TEST_F(TurnedImages, RadiancePicturesInXyzBecomeRgb) {
  const std::vector<int> numbers(shown_width * shown_height, 128);
  const auto light_of = [&](const std::string& header) {
    return read_environment_image(
               write_radiance("ra_xyze -r\nFORMAT=32-bit_rle_xyze\n" + header, "-Y 16 +X 32", numbers))
        .rgb;
  };
  const auto white = light_of("");
  EXPECT_NEAR(white[0], 1.0, 0.003);
  EXPECT_NEAR(white[1], 1.0, 0.003);
  EXPECT_NEAR(white[2], 1.0, 0.003);
  const auto green = light_of("COLORCORR=1 0.8 0.9\n");
  EXPECT_NEAR(green[0], 0.5301, 0.004);
  EXPECT_NEAR(green[1], 1.4934, 0.004);
  EXPECT_NEAR(green[2], 1.0742, 0.004);
}

TEST_F(TurnedImages, ColorsOfRadiancePicturesThatAreNotConvertedAreNamed) {
  const std::vector<int> numbers(shown_width * shown_height, 128);
  const auto problem_of = [&](const std::string& header) {
    return test::error_of([&] { read_environment_image(write_radiance(header, "-Y 16 +X 32", numbers)); });
  };
  EXPECT_THAT(problem_of("PRIMARIES=0.708 0.292\n"), HasSubstr("PRIMARIES"));
  EXPECT_EQ(problem_of("PRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\n"), "");
  EXPECT_THAT(problem_of("EXPOSURE=-1\n"), HasSubstr("EXPOSURE"));
}

}  // namespace
}  // namespace ergodome
