#include "render/passes/overlay/caption_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "content/show/reading/show_reader.h"
#include "render/passes/overlay/caption_notes.h"
#include "render/passes/overlay/overlay_image.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

constexpr int line_px = 40;

CaptionImage caption(const std::string& text, double width_px = 2000.0) {
  return set_caption(text, {line_px, width_px});
}

//! Returns the area that letters cover [px²]. Only letters contain red, because their rim is dark.
double ink(const CaptionImage& caption) {
  double sum = 0.0;
  for (long i = 0; i < static_cast<long>(caption.image.width) * caption.image.height; ++i) {
    sum += caption.image.texels[4 * static_cast<std::size_t>(i)] / 65535.0;
  }
  return sum;
}

class EveryScriptOfDejaVu : public testing::TestWithParam<const char*> {};

TEST_P(EveryScriptOfDejaVu, HasItsLetters) {
  const CaptionImage words = caption(GetParam());
  EXPECT_EQ(letters_without_font(GetParam()), "");
  EXPECT_GT(ink(words), 0.02 * words.image.width * words.image.height);
}

INSTANTIATE_TEST_SUITE_P(All, EveryScriptOfDejaVu,
                         testing::Values("The shadow of a black hole", "Ångström, Zürich, façade, Łódź", "Μαύρη τρύπα",
                                         "Чёрная дыра", "خورشید", "Կարմիր"));

TEST(Captions, DrawDifferentLettersDifferently) {
  const CaptionImage first = caption("α");
  const CaptionImage second = caption("β");
  EXPECT_NE(first.image.texels, second.image.texels);
  EXPECT_NE(caption("Ж").image.texels, caption("Ш").image.texels);
}

TEST(Captions, TellLettersThatNoFontHas) {
  EXPECT_EQ(letters_without_font("a \U0010FFFD b\U0010FFFC \U0010FFFD"), "\U0010FFFD\U0010FFFC");
}

TEST(NotesOfCaptions, NameTheLettersAndTheLanguageThatHaveNoFont) {
  const Show show = parse_show(
      "[[camera.key]]\nr = 20\n[[caption]]\nfrom_s = 0\nto_s = 1\ntext = { en = \"fly\", de = \"a \U0010FFFD\" }\n"
      "[[caption]]\nfrom_s = 1\nto_s = 2\ntext = { de = \"\U0010FFFD \U0010FFFC\" }\n",
      "words.toml");
  const std::vector<std::string> notes = notes_of_captions(show);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], testing::HasSubstr("\U0010FFFD\U0010FFFC of captions in de"));
}

TEST(Captions, ReplaceWhatIsNotUtf8) {
  const CaptionImage broken = caption("a\xff\xfe\x80z");
  EXPECT_EQ(broken.image.texels, caption("a\uFFFD\uFFFD\uFFFDz").image.texels);
}

TEST(Captions, LeaveOutControlCharacters) {
  EXPECT_EQ(caption("a\x1b\r\x07z").image.texels, caption("az").image.texels);
}

TEST(Captions, TakeAnyBytes) {
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    std::string bytes;
    for (unsigned k = 0; k < 5U + random() % 60U; ++k) {
      bytes.push_back(static_cast<char>(random() % 256U));
    }
    const CaptionImage words = set_caption(bytes, {8, static_cast<double>(random() % 300U)});
    EXPECT_EQ(words.image.texels.empty(), words.image.width == 0);
  }
}

TEST(Captions, OfNothingToSeeAreNone) {
  for (const char* text : {"", " ", "\n\n", "\x01"}) {
    EXPECT_EQ(caption(text).image.width, 0) << text;
  }
}

TEST(Captions, AreCutWhereTheyAreEndless) {
  const CaptionImage words = caption(std::string(100000, 'x'), 400.0);
  EXPECT_TRUE(words.too_large || words.image.height <= longest_overlay_px);
}

TEST(Captions, HaveLinesOfTheHeightThatWasAsked) {
  const int one = caption("Hg").image.height;
  EXPECT_NEAR(caption("Hg\nHg").image.height - one, line_px, 1);
  EXPECT_NEAR(caption("Hg\nHg\nHg").image.height - one, 2 * line_px, 1);
}

TEST(Captions, AreBrokenAtTheirWidth) {
  const CaptionImage wide = caption("A line of words that is broken");
  const CaptionImage narrow = caption("A line of words that is broken", 200.0);
  EXPECT_LT(narrow.image.width, 200 + line_px);
  EXPECT_GE(narrow.image.height, wide.image.height + 2 * line_px);
}

TEST(Captions, HaveTheSameLinesInEverySize) {
  const std::string text = "Light is bent by the hole, and its shadow is larger than the hole itself";
  const CaptionImage small = set_caption(text, {16, 160.0});
  const CaptionImage large = set_caption(text, {128, 1280.0});
  EXPECT_EQ(large.image.height / 128, small.image.height / 16);
}

TEST(Captions, AreAsBrightAsTheyAreColoured) {
  const CaptionImage words = set_caption("H", {200, 1000.0, {0.5, 0.25, 0.0}});
  std::uint16_t maximum[4] = {};
  for (std::size_t i = 0; i < 4UL * static_cast<std::size_t>(words.image.width * words.image.height); ++i) {
    maximum[i % 4] = std::max(maximum[i % 4], words.image.texels[i]);
  }
  EXPECT_NEAR(maximum[0], 32768, 1);
  EXPECT_NEAR(maximum[1], 16384, 1);
  EXPECT_EQ(maximum[2], 0);
  EXPECT_EQ(maximum[3], 65535);
}

TEST(Captions, HaveARimThatEndsWithinTheImage) {
  const CaptionImage words = caption("Hg");
  const int width = words.image.width;
  int darkest = 0;
  for (int x = 0; x < width; ++x) {
    EXPECT_EQ(words.image.texels[4 * static_cast<std::size_t>(x) + 3], 0) << x;
    const std::size_t row = static_cast<std::size_t>(words.image.height / 2) * static_cast<std::size_t>(width);
    darkest = std::max<int>(darkest, words.image.texels[4 * (row + static_cast<std::size_t>(x)) + 3]);
  }
  EXPECT_GT(darkest, 45000);
}

TEST(Captions, OfDarkLettersHaveNoRim) {
  const CaptionImage white = set_caption("Hg", {64, 1000.0});
  const CaptionImage black = set_caption("Hg", {64, 1000.0, {0.0, 0.0, 0.0}});
  ASSERT_EQ(black.image.texels.size(), white.image.texels.size());
  for (std::size_t i = 0; i < 4UL * static_cast<std::size_t>(white.image.width * white.image.height); i += 4) {
    // The red channel of white letters equals their coverage.
    EXPECT_EQ(black.image.texels[i + 3], white.image.texels[i]) << i;
  }
}

TEST(OverlayImages, KeepTheirMeanThroughAllLevels) {
  for (const auto& [width, height] : {std::pair(64, 64), std::pair(37, 11), std::pair(1, 9)}) {
    std::vector<float> rgba;
    double mean = 0.0;
    for (int i = 0; i < width * height; ++i) {
      const float light = static_cast<float>(i % 7) / 7.0F;
      mean += static_cast<double>(light) / (width * height);
      rgba.insert(rgba.end(), {light, 0.0F, 1.0F, 1.0F});
    }
    const OverlayImage image = make_overlay_image(width, height, rgba);
    const auto last = static_cast<std::size_t>(image.level_offset[static_cast<std::size_t>(image.level_count - 1)]);
    EXPECT_EQ(image.texels.size(), 4 * (last + 1));
    EXPECT_NEAR(image.texels[4 * last] / 65535.0, mean, 2e-4);
    EXPECT_EQ(image.texels[4 * last + 2], 65535);
    EXPECT_EQ(overlay_image_bytes(width, height), static_cast<long>(2 * image.texels.size()));
  }
}

}  // namespace
}  // namespace ergodome
