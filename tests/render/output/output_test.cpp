#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <random>

#include "kernels/core/error.h"
#include "render/output/frame_files.h"
#include "render/output/image_writer.h"
#include "render/output/tone_map.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;

class Output : public test::FolderTest {
 protected:
  static Picture ramp(int width = 64, int height = 32) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgba.resize(4 * static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
      picture.rgba[i] = static_cast<float>(i % 97) / 60.0F;
    }
    return picture;
  }

  [[nodiscard]] long files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
};

TEST_F(Output, ExrKeepsLinearLightChromaticitiesAndFacts) {
  Picture picture = ramp();
  picture.rgba[0] = std::numeric_limits<float>::quiet_NaN();
  picture.rgba[4] = 1e9F;
  write_picture(folder_ / "a.exr", {ImageFormat::exr}, picture, {{"spin", "0.999"}, {"observer", "zamo"}});
  auto input = OIIO::ImageInput::open((folder_ / "a.exr").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::HALF);
  EXPECT_EQ(input->spec().get_string_attribute("ergodome:spin"), "0.999");
  float chromaticities[8] = {};
  ASSERT_TRUE(input->spec().getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities));
  EXPECT_FLOAT_EQ(chromaticities[0], 0.64F);
  std::vector<float> rgb(3U * 64U * 32U);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, rgb.data()));
  EXPECT_EQ(rgb[0], 0.0F);      // NaN becomes black
  EXPECT_EQ(rgb[3], 65504.0F);  // the largest half float
  EXPECT_NEAR(rgb[3 * 20], picture.rgba[4 * 20], 1e-3);
}

TEST_F(Output, PngIsToneMappedSrgbWithFacts) {
  write_picture(folder_ / "a.png", {ImageFormat::png}, ramp(), {{"show", "A show"}});
  auto input = OIIO::ImageInput::open((folder_ / "a.png").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(input->spec().get_string_attribute("ergodome:show"), "A show");
}

TEST_F(Output, ToneMapKeepsDarkLightEncodesSrgbAndNeverClipsHard) {
  Picture picture;
  picture.width = 4;
  picture.height = 1;
  picture.rgba = {0.0F, 0.2159F, 0.8F, 1, 1.0F, 2.0F, 50.0F, 1, -1.0F, std::nanf(""), 1e30F, 1, 0.001F, 0.5F, 0.9F, 1};
  const auto bytes = tone_mapped(picture);
  EXPECT_EQ(bytes[0], 0);
  EXPECT_NEAR(bytes[1], 128, 1);
  EXPECT_NEAR(bytes[2], 231, 1);  // sRGB value of light 0.8
  EXPECT_LT(bytes[3], bytes[4]);
  EXPECT_EQ(bytes[5], 255);
  EXPECT_EQ(bytes[6], 0);
  EXPECT_EQ(bytes[7], 0);
  EXPECT_EQ(bytes[8], 255);
}

TEST_F(Output, CompleteImagesAreToldFromTornOnes) {
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::exr}) {
    const fs::path path = folder_ / (format == ImageFormat::png ? "a.png" : "a.exr");
    write_picture(path, {format}, ramp(), {});
    EXPECT_TRUE(is_complete_image(path, 64, 32));
    EXPECT_FALSE(is_complete_image(path, 64, 33));
    fs::resize_file(path, fs::file_size(path) * 2 / 3);
    EXPECT_FALSE(is_complete_image(path, 64, 32)) << path;
  }
  EXPECT_FALSE(is_complete_image(folder_ / "absent.png", 64, 32));
}

TEST_F(Output, AFrameWithAnyByteChangedIsNotComplete) {
  for (const FrameFormat& format :
       {FrameFormat{ImageFormat::png}, FrameFormat{ImageFormat::png16}, FrameFormat{ImageFormat::tiff},
        FrameFormat{ImageFormat::exr, ExrCompression::zip}, FrameFormat{ImageFormat::exr, ExrCompression::none},
        FrameFormat{ImageFormat::exr, ExrCompression::dwaa}}) {
    const fs::path path = folder_ / ("a." + file_ending(format.image));
    write_picture(path, format, ramp(), {{"request", "0123456789abcdef"}});
    ASSERT_TRUE(is_complete_image(path, 64, 32)) << path;
    const std::string whole = text(path.filename().string());
    // In a PNG, bytes of text chunks may change, because they are not pixels.
    const std::size_t begin =
        format.image == ImageFormat::png || format.image == ImageFormat::png16 ? whole.find("IDAT") + 4 : 0;
    for (std::size_t at = begin; at + 16 < whole.size(); at += 1 + whole.size() / 60) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
      std::ofstream(path, std::ios::binary) << damaged;
      EXPECT_FALSE(is_complete_image(path, 64, 32)) << path << " byte " << at;
    }
    fs::remove(path);
  }
}

TEST_F(Output, FullDiskIsOneErrorAndLeavesEarlierFramesAlone) {
  write_picture(folder_ / "first.exr", {ImageFormat::exr}, ramp(), {});
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_picture(folder_ / "second.exr", {ImageFormat::exr}, ramp(512, 512), {}), Error);
  EXPECT_THROW(write_picture(folder_ / "second.png", {ImageFormat::png}, ramp(512, 512), {}), Error);
  std::vector<std::uint8_t> noise(3 * 64 * 64);
  std::ranges::generate(noise, std::minstd_rand());
  EXPECT_THROW(write_png(folder_ / "third.png", noise, 64, 64), Error);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(is_complete_image(folder_ / "first.exr", 64, 32));
  EXPECT_EQ(files(), 1);
}

TEST_F(Output, FolderThatIsNotThereIsAnError) {
  EXPECT_THROW(write_picture(folder_ / "no" / "a.png", {ImageFormat::png}, ramp(), {}), Error);
}

TEST(FrameNames, CountFromOneAndSortIntoFoldersOfTenThousand) {
  EXPECT_EQ(frame_path("show", 0, 900, FramePart::whole, "png"), "show_000001.png");
  EXPECT_EQ(frame_path("show", 41, 900, FramePart::left, "exr"), "L/show_000042.exr");
  EXPECT_EQ(frame_path("show", 0, 20'000, FramePart::whole, "png"), "show_000001_010,000/show_000001.png");
  EXPECT_EQ(frame_path("show", 9'999, 20'000, FramePart::right, "png"), "R/show_000001_010,000/show_010000.png");
  EXPECT_EQ(frame_path("show", 10'000, 20'000, FramePart::whole, "png"), "show_010001_020,000/show_010001.png");
}

TEST(FrameNames, OfACubesFacesEndInOpenGlsNames) {
  EXPECT_EQ(frame_path("show", 0, 900, FramePart::whole, "png", CubeFace::right), "show_000001_px.png");
  EXPECT_EQ(frame_path("show", 0, 900, FramePart::left, "exr", CubeFace::front), "L/show_000001_pz.exr");
}

}  // namespace
}  // namespace ergodome
