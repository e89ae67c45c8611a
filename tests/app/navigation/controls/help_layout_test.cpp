#include "app/navigation/controls/help_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "app/navigation/controls/help_text.h"

namespace ergodome {
namespace {

TEST(HelpLayout, GroupsStayWholeInTwoColumnsOfAboutEqualLength) {
  EXPECT_EQ(in_columns("One\na\nb\n\nTwo\nc\n\nThree\nd\ne\nf\n", 2),
            "One    Three\n"
            "a      d\n"
            "b      e\n"
            "       f\n"
            "Two\n"
            "c\n");
  EXPECT_EQ(in_columns("One\na\n\nTwo\nb\n", 1), "One\na\n\nTwo\nb\n");
}

TEST(HelpLayout, CellsOfAColumnStandBelowEachOther) {
  EXPECT_EQ(in_columns("A\t\tgo\nPage Up\t\tback\n\nZ\t\tend\nLast\t\tno\n", 2),
            "A        go      Z     end\n"
            "Page Up  back    Last  no\n");
}

TEST(HelpLayout, CountsLettersAndNotBytes) {
  EXPECT_EQ(count_letters("Länge"), 5U);
  EXPECT_EQ(in_columns("größer\n\nb\n", 2), "größer    b\n");
}

//! Returns the size of a text in letters of equal width, including the margin of a help panel.
TextSize measured(const std::string& text, int letter_px) {
  std::stringstream lines(text);
  std::size_t longest = 0;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    longest = std::max(longest, count_letters(line));
  }
  return {static_cast<int>(0.6 * letter_px * static_cast<double>(longest)) + letter_px,
          3 * letter_px * count / 2 + letter_px};
}

FittedText fit(const std::string& list, const TextSize& window, int usual_px) {
  return fit_list(list, window, usual_px, measured);
}

TEST(HelpLayout, LettersAreAsLargeAsTheWindowLetsThem) {
  // Two lines with line spacing and margin are as high as four letters and a little more, so a
  // window of 50 px allows letters of 12 px.
  const FittedText roomy = fit("a\nb\n\nc\nd\n", {1000, 1000}, 20);
  EXPECT_EQ(roomy.text, "a    c\nb    d\n");
  EXPECT_EQ(roomy.letter_px, 20);
  EXPECT_EQ(fit("a\nb\n\nc\nd\n", {1000, 50}, 20).letter_px, 12);
}

TEST(HelpLayout, AnEmptyListStaysOne) {
  EXPECT_EQ(in_columns("", 2), "");
  EXPECT_EQ(fit("", {640, 360}, 11).text, "");
}

TEST(HelpLayout, WhereNothingFitsLettersAreSmallest) { EXPECT_EQ(fit("a\n\nb\n", {0, 0}, 20).letter_px, 6); }

TEST(HelpLayout, TheProgramsHelpFitsIntoSmallWindows) {
  for (const auto& [window, min_px] : {std::pair(TextSize{700, 700}, 8), std::pair(TextSize{640, 360}, 7)}) {
    for (const char* language : {"en", "de"}) {
      const HelpChoice choice = {.pads = false, .language = language, .form = HelpForm::cells};
      const FittedText fitted = fit(help_text(Controls(), choice), window, 14);
      const TextSize size = measured(fitted.text, fitted.letter_px);
      EXPECT_LE(size.width_px, window.width_px) << language;
      EXPECT_LE(size.height_px, window.height_px) << language;
      EXPECT_GE(fitted.letter_px, min_px) << language;
    }
  }
}

}  // namespace
}  // namespace ergodome
