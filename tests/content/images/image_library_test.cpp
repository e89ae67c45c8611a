#include "content/images/image_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <utility>

#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::HasSubstr;
using testing::Not;

using ImageLibraryFiles = test::FolderTest;

TEST_F(ImageLibraryFiles, SaysWhyAFileIsNoImage) {
  std::string problem;
  std::ofstream(folder_ / "text.png") << "no picture";
  EXPECT_EQ(image_library().open((folder_ / "text.png").string(), {}, problem), nullptr);
  EXPECT_THAT(problem, HasSubstr("PNG"));
}

TEST_F(ImageLibraryFiles, ReadsBytesOfNoneAsNoImageWhateverLiesOnTheDisk) {
  std::string problem;
  const auto output = image_library().create("png", nullptr, problem);
  const std::string path = (folder_ / "one.png").string();
  const ImagePlan plan[] = {{2, 1, 1, ImageSample::whole_8, {}, {}, {}}};
  const float pixels[2] = {0.0F, 1.0F};
  ASSERT_TRUE(output && output->open(path, plan) && output->write(pixels) && output->close());
  EXPECT_NE(image_library().open(path, {}, problem), nullptr);
  EXPECT_EQ(image_library().open(path, {std::span<const std::byte>()}, problem), nullptr);
}

//! Writes a gray image with noise, in a format of OpenImageIO.
std::vector<unsigned char> noisy_image(const char* format) {
  std::vector<unsigned char> bytes;
  std::string problem;
  const auto output = image_library().create(format, &bytes, problem);
  std::vector<float> pixels(64 * 64 * 3);
  std::minstd_rand noise;
  std::ranges::generate(pixels, [&] { return std::uniform_real_distribution<float>()(noise); });
  const ImagePlan plan[] = {{64, 64, 3, ImageSample::whole_8, {}, {}, {}}};
  const bool written = output && output->open("noise", plan) && output->write(pixels.data()) && output->close();
  return written ? bytes : std::vector<unsigned char>();
}

TEST_F(ImageLibraryFiles, SaysThatAJpegIsTornWhereverItBreaksOff) {
  const std::vector<unsigned char> jpeg = noisy_image("jpeg");
  const auto opened = [&](std::size_t count) {
    std::string problem;
    return image_library().open("noise.jpg", {std::as_bytes(std::span(jpeg).first(count))}, problem) != nullptr;
  };
  ASSERT_GT(jpeg.size(), 2000U);
  EXPECT_TRUE(opened(jpeg.size()));
  for (const std::size_t left : {jpeg.size() - 1, jpeg.size() / 2, jpeg.size() / 4}) {
    EXPECT_FALSE(opened(left)) << left;
  }
}

//! Opens and reads a PNG image. Returns our error message, and what libpng prints on stderr.
std::pair<std::string, std::string> png_messages(const std::string& name, const ImageLibrary::Wishes& wishes) {
  std::string problem;
  testing::internal::CaptureStderr();
  const auto input = image_library().open(name, wishes, problem);
  if (input && !input->read_through()) {
    problem = input->error();
  }
  return {problem, testing::internal::GetCapturedStderr()};
}

TEST_F(ImageLibraryFiles, SaysInOneLineThatAPngIsTornWhereverItBreaksOff) {
  const std::vector<unsigned char> png = noisy_image("png");
  ASSERT_GT(png.size(), 2000U);
  for (const std::size_t left : {png.size() - 1, png.size() - 12, png.size() / 2, std::size_t{30}, std::size_t{8}}) {
    const auto [problem, of_library] = png_messages("noise.png", {std::as_bytes(std::span(png).first(left))});
    EXPECT_THAT(problem, testing::AllOf(HasSubstr("truncated"), Not(HasSubstr("\n")))) << left;
    EXPECT_EQ(of_library, "") << left;
  }
}

TEST_F(ImageLibraryFiles, SaysInOneLineThatAByteOfAPngIsAnother) {
  const std::vector<unsigned char> whole = noisy_image("png");
  ASSERT_GT(whole.size(), 2000U);
  const std::string path = (folder_ / "changed.png").string();
  for (const std::size_t at : {std::size_t{8}, std::size_t{17}, whole.size() / 2, whole.size() - 6}) {
    std::vector<unsigned char> png = whole;
    png[at] ^= 0x80U;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    for (const auto& [problem, of_library] :
         {png_messages(path, {}), png_messages("noise.png", {std::as_bytes(std::span(png))})}) {
      EXPECT_THAT(problem, testing::AllOf(HasSubstr("damaged"), Not(HasSubstr("\n")))) << at;
      EXPECT_EQ(of_library, "") << at;
    }
  }
}

TEST_F(ImageLibraryFiles, ReadsAWholePngWithoutAWord) {
  const std::vector<unsigned char> png = noisy_image("png");
  EXPECT_EQ(png_messages("noise.png", {std::as_bytes(std::span(png))}), std::pair(std::string(), std::string()));
}

TEST_F(ImageLibraryFiles, ReadsRowsPartsAndWholeImagesAsTheyWereWritten) {
  std::string problem;
  const auto output = image_library().create("openexr", nullptr, problem);
  ASSERT_NE(output, nullptr) << problem;
  const std::string path = (folder_ / "two.exr").string();
  const ImagePlan plans[] = {{2, 3, 3, ImageSample::half, {{"oiio:subimagename", "left"}, {"view", "left"}}, {}, {}},
                             {2, 3, 3, ImageSample::half, {{"oiio:subimagename", "right"}, {"view", "right"}}, {}, {}}};
  std::vector<float> left(18);
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = 0.25F * static_cast<float>(i);
  }
  const std::vector<float> right(18, 7.0F);
  ASSERT_TRUE(output->open(path, plans) && output->write(left.data()) && output->open_next(path, plans[1]) &&
              output->write(right.data()) && output->close());
  const auto input = image_library().open(path, {}, problem);
  ASSERT_NE(input, nullptr) << problem;
  EXPECT_EQ(input->shape().width, 2);
  EXPECT_EQ(input->shape().height, 3);
  EXPECT_FALSE(input->shape().encoded);
  std::vector<float> row(6);
  ASSERT_TRUE(input->read_rows(1, 2, 3, row.data()));
  EXPECT_EQ(row, std::vector<float>(left.begin() + 6, left.begin() + 12));
  std::vector<float> all(18);
  ASSERT_TRUE(input->go_to_part(1));
  ASSERT_TRUE(input->read_all(3, all.data()));
  EXPECT_EQ(all, right);
  EXPECT_TRUE(input->read_through());
  EXPECT_FALSE(input->go_to_part(2));
}

TEST_F(ImageLibraryFiles, TurnsPixelsAsTheFileTells) {
  // The image has the rows 012 and 345. The strings show its pixels as displayed for each Exif
  // orientation, starting with orientation 1.
  const char* const shown[] = {"012345", "210543", "543210", "345012", "031425", "304152", "524130", "251403"};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    std::vector<unsigned char> bytes;
    std::string problem;
    const auto output = image_library().create("openexr", &bytes, problem);
    const ImagePlan plan[] = {{3, 2, 1, ImageSample::half, {}, {{"Orientation", orientation}}, {}}};
    const std::uint8_t pixels[] = {0, 1, 2, 3, 4, 5};
    ASSERT_TRUE(output && output->open("turned.exr", plan) && output->write(pixels) && output->close()) << problem;
    const auto input = image_library().open("turned.exr", {std::as_bytes(std::span(bytes))}, problem);
    ASSERT_NE(input, nullptr) << problem;
    const int width = orientation > 4 ? 2 : 3;
    EXPECT_EQ(input->shape().width, width);
    float all[6];
    ASSERT_TRUE(input->read_all(1, all));
    std::string text;
    std::ranges::transform(all, std::back_inserter(text),
                           [](float value) { return static_cast<char>('0' + std::lround(255.0F * value)); });
    EXPECT_EQ(text, shown[orientation - 1]) << orientation;
    float row[3];
    ASSERT_TRUE(input->read_rows(1, 2, 1, row));
    EXPECT_TRUE(std::equal(row, row + width, all + width)) << orientation;
  }
}

TEST(ImageLibrary, KnowsNoFormatOfThatName) {
  std::string problem;
  EXPECT_EQ(image_library().create("notaformat", nullptr, problem), nullptr);
  EXPECT_FALSE(problem.empty());
}

}  // namespace
}  // namespace ergodome
