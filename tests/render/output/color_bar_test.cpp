#include "render/output/color_bar.h"

#include <gtest/gtest.h>

#include <utility>

#include "content/images/image_library.h"

namespace ergodome {
namespace {

//! Expects that the labels of a color bar fit into a picture without overlap.
void expect_apart(const ColorBarLayout& bar, int width_px, int height_px) {
  EXPECT_GE(bar.letter_px, 9);
  EXPECT_GE(bar.texts.size(), 3U) << "a title, and numbers at both ends";
  int row_end = 0;
  int row_y = 0;
  for (const BarText& text : bar.texts) {
    const int text_width = image_library().text_box(text.text, bar.letter_px).width;
    ASSERT_GT(text_width, 0) << text.text;
    const int left = text.middle_x - text_width / 2;
    EXPECT_GE(left, text.top_y == row_y ? row_end + 2 : 0) << text.text;
    row_end = left + text_width;
    row_y = text.top_y;
    EXPECT_LE(row_end, width_px / 2) << text.text;
    EXPECT_GT(text.top_y, height_px / 2) << text.text;
    EXPECT_LE(text.top_y + bar.letter_px, height_px) << text.text;
  }
}

TEST(ColorBars, KeepTheirWordsInTheLeftHalfOfThePictureAndApart) {
  for (const auto& [width, height] : {std::pair{160, 100}, {200, 200}, {1024, 1024}}) {
    for (const ViewMode mode : {ViewMode::steps, ViewMode::error_estimate, ViewMode::image_order,
                                ViewMode::frequency_ratio, ViewMode::magnification}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", view " << static_cast<int>(mode));
      expect_apart(color_bar_layout(width, height, heat_range(mode), mode), width, height);
    }
  }
  expect_apart(color_bar_layout(200, 200, heat_range(ViewMode::steps, true), ViewMode::steps), 200, 200);
}

TEST(ColorBars, HaveMoreNumbersWhereThereIsRoom) {
  const HeatRange range = heat_range(ViewMode::magnification);
  EXPECT_EQ(color_bar_layout(2048, 2048, range, ViewMode::magnification).texts.size(), 6U);
  EXPECT_LT(color_bar_layout(200, 200, range, ViewMode::magnification).texts.size(), 6U);
}

TEST(ColorBars, TellTheNumbersOfNarrowRangesApart) {
  const ColorBarLayout narrow = color_bar_layout(2048, 2048, HeatRange{1.0, 1.0002, true}, ViewMode::frequency_ratio);
  ASSERT_EQ(narrow.texts.size(), 6U);
  EXPECT_EQ(narrow.texts[0].text, "1");
  EXPECT_EQ(narrow.texts[1].text, "1.00005");
  EXPECT_EQ(narrow.texts[4].text, "1.0002");
  const ColorBarLayout usual = color_bar_layout(2048, 2048, HeatRange{0.3, 3.0, true}, ViewMode::frequency_ratio);
  EXPECT_EQ(usual.texts[1].text, "0.533");
}

TEST(ColorBars, AreLeftOutOfPicturesThatAreTooSmall) {
  EXPECT_EQ(color_bar_layout(159, 159, heat_range(ViewMode::steps), ViewMode::steps).width, 0);
}

TEST(ColorBars, TakeTheirPartOfThePictureWhereThereIsRoomForOne) {
  const HeatRange range = heat_range(ViewMode::steps);
  const ColorBarLayout bar = color_bar_layout(400, 300, range, ViewMode::steps);
  EXPECT_GE(300.0 * color_bar_part(400, 300), 300 - bar.texts.back().top_y);
}

TEST(ColorBars, TakeNothingOfAPictureThatIsTooSmall) {
  EXPECT_EQ(color_bar_part(64, 64), 0.0);
  EXPECT_EQ(color_bar_part(159, 300), 0.0);
}

}  // namespace
}  // namespace ergodome
