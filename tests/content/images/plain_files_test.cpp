#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "content/images/plain/plain_jpeg.h"
#include "content/images/plain/png_file.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

const std::string map_file = ERGODOME_SOURCE_DIR "/content/maps/milky_way.jpg";

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class PlainFiles : public test::FolderTest {
 protected:
  //! Writes a file into the folder and returns its path.
  [[nodiscard]] std::string written(const std::string& name, const std::string& bytes) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
};

std::vector<float> rows_of(ImageInput& input, int begin, int end) {
  std::vector<float> rows(3 * static_cast<std::size_t>(input.shape().width) * static_cast<std::size_t>(end - begin));
  EXPECT_TRUE(input.read_rows(begin, end, 3, rows.data()));
  return rows;
}

TEST_F(PlainFiles, TheBuiltInMapIsThatOfTheImageLibrary) {
  std::string problem;
  const auto plain = open_plain_jpeg(map_file);
  ImageLibrary::Wishes wishes;
  wishes.separate_alpha = wishes.as_light = true;
  const auto library = image_library().open(map_file, wishes, problem);
  ASSERT_TRUE(plain && library) << problem;
  EXPECT_EQ(plain->shape().width, library->shape().width);
  EXPECT_EQ(plain->shape().height, library->shape().height);
  EXPECT_EQ(plain->shape().channels, library->shape().channels);
  EXPECT_EQ(plain->shape().encoded, library->shape().encoded);
  EXPECT_EQ(rows_of(*plain, 0, plain->shape().height), rows_of(*library, 0, library->shape().height));
}

TEST_F(PlainFiles, RowsOfAJpegAreReadInAnyOrder) {
  const auto input = open_plain_jpeg(map_file);
  ASSERT_NE(input, nullptr);
  const std::vector<float> rows = rows_of(*input, 0, 20);
  EXPECT_TRUE(std::ranges::equal(rows_of(*input, 30, 31), rows_of(*open_plain_jpeg(map_file), 30, 31)));
  const auto row = static_cast<std::ptrdiff_t>(rows.size() / 20);
  EXPECT_TRUE(std::ranges::equal(rows_of(*input, 5, 7), std::span(rows).subspan(static_cast<std::size_t>(5 * row),
                                                                                static_cast<std::size_t>(2 * row))));
}

TEST_F(PlainFiles, AJpegWithMetadataOrWithoutItsEndIsNotPlain) {
  const std::string jpeg = bytes_of(map_file);
  ASSERT_NE(open_plain_jpeg(written("whole.jpg", jpeg)), nullptr);
  // Exif, a color profile, Adobe's color transform, and a comment
  for (const char marker : {'\xE1', '\xE2', '\xEE', '\xFE'}) {
    const std::string segment = {'\xFF', marker, '\0', '\x04', 'E', 'x'};
    EXPECT_EQ(open_plain_jpeg(written("segment.jpg", jpeg.substr(0, 2) + segment + jpeg.substr(2))), nullptr);
  }
  EXPECT_EQ(open_plain_jpeg(written("truncated.jpg", jpeg.substr(0, jpeg.size() / 2))), nullptr);
  EXPECT_EQ(open_plain_jpeg(written("text.jpg", "no picture")), nullptr);
  EXPECT_EQ(open_plain_jpeg((folder_ / "missing.jpg").string()), nullptr);
}

//! A picture with smooth and noisy parts.
template <class Number>
std::vector<Number> pixels_of(const ImagePlan& plan, int largest) {
  std::minstd_rand random;
  std::vector<Number> pixels;
  for (int i = 0; i < plan.width * plan.height * plan.channels; ++i) {
    const int noise = i % 7 == 0 ? static_cast<int>(random() % 256) : 0;
    pixels.push_back(static_cast<Number>((37 * i + noise) % (largest + 1)));
  }
  return pixels;
}

template <class Number>
bool write_image(ImageOutput* output, const std::string& path, const ImagePlan& plan,
                 const std::vector<Number>& pixels) {
  return output != nullptr && output->open(path, std::span(&plan, 1)) && output->write(pixels.data()) &&
         output->close();
}

//! Writes a picture with both writers. Expects the same chunks before the pixels and the same
//! pixels.
template <class Number>
void expect_image_of_library(const std::filesystem::path& folder, ImagePlan plan, int largest) {
  plan.width = 61;
  plan.height = 47;
  plan.texts.insert(plan.texts.begin(), {{"ergodome:show", "A show"}, {"Software", "Ergodome"}});
  plan.numbers = {{"oiio:UnassociatedAlpha", 1}};
  const std::vector<Number> pixels = pixels_of<Number>(plan, largest);
  const std::string own = (folder / "own.png").string();
  const std::string library = (folder / "library.png").string();
  std::string problem;
  ASSERT_TRUE(is_for_png_output(plan));
  ASSERT_TRUE(write_image(png_output().get(), own, plan, pixels));
  ASSERT_TRUE(write_image(image_library().create("png", nullptr, problem).get(), library, plan, pixels));
  const std::string head = bytes_of(own).substr(0, bytes_of(own).find("IDAT") - 4);
  EXPECT_EQ(head, bytes_of(library).substr(0, head.size()));
  for (const std::string& path : {own, library}) {
    EXPECT_EQ(is_whole_png(path, plan.width, plan.height), true);
    ImageLibrary::Wishes wishes;
    wishes.separate_alpha = wishes.as_stored = true;
    const auto input = image_library().open(path, wishes, problem);
    ASSERT_NE(input, nullptr) << problem;
    std::vector<std::uint16_t> read(pixels.size());
    ASSERT_TRUE(input->read_all(plan.channels, read.data()));
    const int scale = 65'535 / largest;
    EXPECT_TRUE(std::ranges::equal(read, pixels, {}, {}, [&](Number number) { return number * scale; }));
  }
}

TEST_F(PlainFiles, PngsAreThoseOfTheImageLibrary) {
  for (const int channels : {3, 4}) {
    ImagePlan plan;
    plan.channels = channels;
    plan.texts = {{"oiio:ColorSpace", "sRGB"}};
    expect_image_of_library<std::uint8_t>(folder_, plan, 255);
    plan.sample = ImageSample::whole_16;
    expect_image_of_library<std::uint16_t>(folder_, plan, 65'535);
  }
}

TEST_F(PlainFiles, PngsWithoutAColorSpaceAreThoseOfTheImageLibrary) {
  expect_image_of_library<std::uint8_t>(folder_, {}, 255);
}

TEST_F(PlainFiles, DamagedPngsAreNotWhole) {
  ImagePlan plan;
  plan.width = 61;
  plan.height = 47;
  const std::string path = (folder_ / "whole.png").string();
  ASSERT_TRUE(write_image(png_output().get(), path, plan, pixels_of<std::uint8_t>(plan, 255)));
  EXPECT_EQ(is_whole_png(path, 61, 47), true);
  EXPECT_EQ(is_whole_png(path, 47, 61), false);
  const std::string png = bytes_of(path);
  for (const std::size_t left : {png.size() - 1, png.size() - 12, png.size() / 2, std::size_t{40}}) {
    EXPECT_EQ(is_whole_png(written("truncated.png", png.substr(0, left)), 61, 47), false) << left;
  }
  for (const std::size_t at : {std::size_t{28}, png.size() / 2, png.size() - 6}) {
    std::string changed = png;
    changed[at] = static_cast<char>(changed[at] ^ '\x40');
    EXPECT_NE(is_whole_png(written("changed.png", changed), 61, 47), true) << at;
  }
}

TEST_F(PlainFiles, OtherPngsAreLeftToTheImageLibrary) {
  ImagePlan plan;
  plan.width = 61;
  plan.height = 47;
  plan.channels = 1;
  EXPECT_FALSE(is_for_png_output(plan));
  std::string problem;
  const std::string path = (folder_ / "gray.png").string();
  ASSERT_TRUE(write_image(image_library().create("png", nullptr, problem).get(), path, plan,
                          pixels_of<std::uint8_t>(plan, 255)));
  EXPECT_EQ(is_whole_png(path, 61, 47), std::nullopt);
  plan.channels = 3;
  plan.width = plan.height = 20'000;
  EXPECT_FALSE(is_for_png_output(plan));
}

TEST_F(PlainFiles, APngThatCannotBeWrittenIsReported) {
  ImagePlan plan;
  plan.width = plan.height = 8;
  const auto output = png_output();
  EXPECT_FALSE(output->open((folder_ / "no" / "a.png").string(), std::span(&plan, 1)));
  EXPECT_THAT(output->error(), testing::HasSubstr("No such file"));
}

}  // namespace
}  // namespace ergodome
