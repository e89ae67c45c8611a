#include "app/navigation/help_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "app/navigation/controls.h"

namespace ergodome {
namespace {

TEST(HelpLayout, BlocksStandBesideEachOtherInTheListsOrder) {
  EXPECT_EQ(in_blocks("one\ntwo\nthree\nfour\nfive\n", 2),
            "one     four\n"
            "two     five\n"
            "three\n");
  EXPECT_EQ(in_blocks("one\ntwo\n", 1), "one\ntwo\n");
}

TEST(HelpLayout, CellsOfABlockStandBelowEachOther) {
  EXPECT_EQ(in_blocks("A\t\tgo\nPage Up\t\tback\nZ\t\tend\nLast\t\tno\n", 2),
            "A        go     Z     end\n"
            "Page Up  back   Last  no\n");
}

TEST(HelpLayout, CountsLettersAndNotBytes) {
  EXPECT_EQ(count_letters("Länge"), 5U);
  EXPECT_EQ(in_blocks("größer\nb\n", 2), "größer   b\n");
}

//! Letters of one width, with a margin as text on a panel has.
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

TEST(HelpLayout, OneBlockIsKeptWhereItFits) {
  const FittedText fitted = fit("a\nb\nc\n", {1000, 1000}, 20);
  EXPECT_EQ(fitted.text, "a\nb\nc\n");
  EXPECT_EQ(fitted.letter_px, 20);
}

TEST(HelpLayout, AnEmptyListStaysOne) {
  EXPECT_EQ(in_blocks("", 3), "");
  EXPECT_EQ(fit("", {640, 360}, 11).text, "");
}

TEST(HelpLayout, TwoBlocksAreTakenWhereTheyLetLettersBeLarger) {
  // One block of four lines fits with 7 px, two of two with 12, and four in a row not at all.
  const FittedText fitted = fit("a\nb\nc\nd\n", {60, 50}, 20);
  EXPECT_EQ(fitted.text, "a   c\nb   d\n");
  EXPECT_EQ(fitted.letter_px, 12);
}

TEST(HelpLayout, WhereNothingFitsItIsCutOffLeast) {
  EXPECT_EQ(fit("a\nb\nc\nd\n", {1000, 9}, 20).text, "a   b   c   d\n");
  EXPECT_EQ(fit("a\nb\n", {0, 0}, 20).letter_px, 6);
}

TEST(HelpLayout, TheProgramsHelpFitsIntoAWindowOf700PixelsBelowTwoLinesOfTimes) {
  const TextSize below_times = {700, 700 - measured("times\ndisparity\n", 14).height_px};
  for (const char* language : {"en", "de"}) {
    const HelpChoice choice = {.pads = false, .language = language, .form = HelpForm::cells};
    const FittedText fitted = fit(Controls().help_text(choice), below_times, 14);
    const TextSize size = measured(fitted.text, fitted.letter_px);
    EXPECT_LE(size.width_px, 700) << language;
    EXPECT_LE(size.height_px, below_times.height_px) << language;
    EXPECT_GE(fitted.letter_px, 8) << language;
  }
}

}  // namespace
}  // namespace ergodome
