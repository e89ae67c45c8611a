#include "render/output/text_image.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

namespace ergodome {
namespace {

constexpr int letter_px = 16;

class WrappedLines : public testing::Test {
 protected:
  void SetUp() override {
    if (text_lines_image("a", letter_px).width == 0) {
      GTEST_SKIP() << "no font is installed";
    }
  }

  static TextImage wrapped(const std::string& text, int widest_px) {
    return text_lines_image(text, letter_px, TextFace::proportional, widest_px);
  }

  //! Returns the area that letters cover [px²].
  static double ink(const TextImage& image) {
    return std::accumulate(image.coverage.begin(), image.coverage.end(), 0.0);
  }

  static void expect_all_there(const std::string& text, int widest_px) {
    const TextImage whole = text_lines_image(text, letter_px);
    const TextImage image = wrapped(text, widest_px);
    EXPECT_LE(image.width, widest_px) << text;
    EXPECT_GT(image.width, widest_px / 2) << text;
    EXPECT_GT(image.height, whole.height) << text;
    EXPECT_NEAR(ink(image), ink(whole), 0.05 * ink(whole)) << text;
  }
};

TEST_F(WrappedLines, AreNoWiderThanAsked) {
  const std::string text =
      "12.3 ms at 1024 px, grid lens, cuda\nanaglyph, physical, baseline 0.1 M, convergence infinity";
  const int whole_px = text_lines_image(text, letter_px).width;
  for (const int widest_px : {1, 7, 16, 40, 100, 333, 480, whole_px - 1}) {
    const TextImage image = wrapped(text, widest_px);
    EXPECT_GT(image.width, 0) << widest_px;
    EXPECT_LE(image.width, widest_px);
    EXPECT_EQ(image.coverage.size(), static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const TextLinesSize size = text_lines_size(text, letter_px, TextFace::proportional, widest_px);
    EXPECT_EQ(size.width, image.width);
    EXPECT_EQ(size.height, image.height);
  }
}

TEST_F(WrappedLines, LoseNothing) {
  expect_all_there("the shadow of a black hole that turns, seen from five of its radii away", 200);
  expect_all_there("/a/folder/of-a-name-without-any-space-in-it/calibrated/dome-setup.toml", 200);
}

TEST_F(WrappedLines, LoseNothingWhereTheyRunToTheLeft) {
  expect_all_there("خورشید خورشید خورشید خورشید خورشید خورشید خورشید خورشید خورشید", 150);
}

TEST_F(WrappedLines, StayAsTheyAreWhereThereIsRoom) {
  const TextImage whole = text_lines_image("two\nlines", letter_px);
  for (const int widest_px : {0, whole.width, 5000}) {
    const TextImage image = wrapped("two\nlines", widest_px);
    EXPECT_EQ(image.width, whole.width);
    EXPECT_EQ(image.coverage, whole.coverage);
  }
}

}  // namespace
}  // namespace ergodome
