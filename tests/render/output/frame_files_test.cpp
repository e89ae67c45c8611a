#include "render/output/frame_files.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "kernels/core/error.h"
#include "render/output/image_reader.h"
#include "render/output/image_writer.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;

//! Returns light that rises by a quarter of an 8-bit step from pixel to pixel; the lower half has a
//! coverage of one half.
Picture fine_ramp() {
  Picture picture;
  picture.width = 256;
  picture.height = 2;
  picture.rgba.resize(4 * 512);
  for (std::size_t i = 0; i < 512; ++i) {
    const float light = 0.2F + 0.001F * static_cast<float>(i % 256);
    const float coverage = i < 256 ? 1.0F : 0.5F;
    const float rgba[4] = {coverage * light, coverage * light, 0.0F, coverage};
    std::copy_n(rgba, 4, picture.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return picture;
}

class FrameFiles : public test::FolderTest {
 protected:
  fs::path written(const FrameFormat& format) {
    fs::path path = folder_ / ("a." + file_ending(format.image));
    write_picture(path, format, fine_ramp(), {{"spin", "0.999"}});
    return path;
  }
  static OIIO::ImageSpec spec_of(const fs::path& path) { return OIIO::ImageInput::open(path.string())->spec(); }
};

TEST_F(FrameFiles, SixteenBitsTellApartWhatEightCannot) {
  for (const ImageFormat format : {ImageFormat::png16, ImageFormat::tiff}) {
    const DisplayPixels pixels = read_display_pixels(written({format}));
    for (std::size_t i = 1; i < 256; ++i) {
      ASSERT_GT(pixels.values[3 * i], pixels.values[3 * (i - 1)]) << i;
    }
  }
}

TEST_F(FrameFiles, SixteenBitsAreTheSrgbCurveOfTheLight) {
  const DisplayPixels pixels = read_display_pixels(written({ImageFormat::tiff}));
  for (const int i : {0, 100, 255}) {
    const double light = 0.2 + 0.001 * i;
    const double expected = 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    EXPECT_NEAR(pixels.values[3 * static_cast<std::size_t>(i)] / 65535.0, expected, 3e-5) << i;
  }
}

TEST_F(FrameFiles, TiffIsLosslessWithFactsInItsDescription) {
  const OIIO::ImageSpec spec = spec_of(written({ImageFormat::tiff}));
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT16);
  EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
  EXPECT_EQ(spec.get_string_attribute("ImageDescription"), "spin=0.999\n");
}

TEST_F(FrameFiles, ExrIsPackedAsAsked) {
  EXPECT_EQ(spec_of(written({ImageFormat::exr, ExrCompression::none})).get_string_attribute("compression"), "none");
  EXPECT_EQ(spec_of(written({ImageFormat::exr, ExrCompression::zip})).get_string_attribute("compression"), "zip");
  EXPECT_EQ(spec_of(written({ImageFormat::exr, ExrCompression::dwaa})).get_string_attribute("compression"), "dwaa");
}

TEST_F(FrameFiles, ExrTellsTheRateOfItsSequenceAsAFraction) {
  FrameFormat format{ImageFormat::exr};
  format.rate = frame_rate_of(29.97);
  const OIIO::ImageSpec spec = spec_of(written(format));
  const OIIO::ParamValue* const rate = spec.find_attribute("FramesPerSecond", OIIO::TypeRational);
  ASSERT_NE(rate, nullptr);
  EXPECT_EQ(rate->get_string(), "30000/1001");
}

TEST_F(FrameFiles, AlphaIsTheCoverageAndLightIsTimesIt) {
  const auto input = OIIO::ImageInput::open(written({ImageFormat::exr, ExrCompression::none, true}).string());
  ASSERT_EQ(input->spec().nchannels, 4);
  std::vector<float> rgba(4 * 512);
  ASSERT_TRUE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, rgba.data()));
  EXPECT_EQ(rgba[3], 1.0F);
  EXPECT_EQ(rgba[4 * 256 + 3], 0.5F);
  EXPECT_NEAR(rgba[static_cast<std::size_t>(4 * 256)], 0.1F, 1e-4F);
}

TEST_F(FrameFiles, WhatIsDisplayedHasItsLightBesideTheCoverage) {
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::png16, ImageFormat::tiff}) {
    OIIO::ImageSpec as_stored;
    as_stored["oiio:UnassociatedAlpha"] = 1;
    const auto input = OIIO::ImageInput::open(written({format, ExrCompression::zip, true}).string(), &as_stored);
    ASSERT_TRUE(input) << OIIO::geterror();
    EXPECT_EQ(input->spec().get_int_attribute("oiio:UnassociatedAlpha"), 1) << file_ending(format);
    std::vector<float> rgba(4 * 512);
    ASSERT_TRUE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, rgba.data()));
    EXPECT_NEAR(rgba[4 * 256 + 3], 0.5F, 0.003F);
    for (std::size_t i = 0; i < 256; ++i) {
      ASSERT_EQ(rgba[4 * (256 + i)], rgba[4 * i]) << file_ending(format) << " " << i;
    }
  }
}

TEST_F(FrameFiles, AlphaIsInEveryFormat) {
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::png16, ImageFormat::tiff, ImageFormat::exr}) {
    const OIIO::ImageSpec spec = spec_of(written({format, ExrCompression::zip, true}));
    EXPECT_EQ(spec.nchannels, 4) << file_ending(format);
    EXPECT_EQ(spec.alpha_channel, 3) << file_ending(format);
  }
}

TEST_F(FrameFiles, AnOpaquePixelIsTheSameWithAlphaAndWithout) {
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::png16, ImageFormat::tiff}) {
    const DisplayPixels without = read_display_pixels(written({format}));
    const DisplayPixels with = read_display_pixels(written({format, ExrCompression::zip, true}));
    for (std::size_t i = 0; i < 3 * 256; ++i) {
      ASSERT_EQ(with.values[i], without.values[i]) << file_ending(format) << " " << i;
    }
  }
}

TEST_F(FrameFiles, WhatIsNoPictureCannotBeRead) {
  EXPECT_THROW(static_cast<void>(read_display_pixels(folder_ / "absent.png")), Error);
  EXPECT_THROW(static_cast<void>(read_display_pixels(folder_)), Error);
}

TEST(FrameFormats, WordsAreFormats) {
  EXPECT_EQ(frame_format("tiff", "", false).image, ImageFormat::tiff);
  EXPECT_EQ(frame_format("exr", "dwaa", true).compression, ExrCompression::dwaa);
  EXPECT_TRUE(frame_format("exr", "dwaa", true).alpha);
  EXPECT_EQ(frame_format("exr", "", false).compression, ExrCompression::zip);
}

TEST(FrameFormats, CompressionIsRefusedForWhatHasNoChoice) {
  EXPECT_THROW(static_cast<void>(frame_format("png", "zip", false)), Error);
}

}  // namespace
}  // namespace ergodome
