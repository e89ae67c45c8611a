#include "calibration/warps/pfm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Numbers in IEEE 754 single precision, least significant byte first: 1 is 3f800000, 2 is 40000000,
// 0.5 is 3f000000, -1 is bf800000.
const std::string one("\x00\x00\x80\x3f", 4);
const std::string two("\x00\x00\x00\x40", 4);
const std::string half("\x00\x00\x00\x3f", 4);
const std::string unknown_bytes("\x00\x00\xc0\x7f", 4);
const std::string zero(4, '\0');

const std::string first_row = one + two + half + half + half + half;
const std::string second_row = two + two + two + unknown_bytes + unknown_bytes + zero;
const std::string by_hand = "PF\n2 2\n-1.0\n" + first_row + second_row;

FloatMap parsed(const std::string& bytes, RowOrder order = RowOrder::bottom_up) {
  return parse_float_map(std::as_bytes(std::span(bytes)), "warp.pfm", order);
}

std::string map_problem(const std::string& bytes) {
  return test::error_of([&] { parsed(bytes); });
}

TEST(FloatMapFile, FirstRowOfTheFileIsTheBottom) {
  const FloatMap map = parsed(by_hand);
  EXPECT_EQ(map.width, 2);
  EXPECT_EQ(map.height, 2);
  EXPECT_EQ(map.samples[0], 2.0F);
  EXPECT_EQ(map.samples[6], 1.0F);
  EXPECT_EQ(map.samples[7], 2.0F);
  EXPECT_EQ(map.samples[8], 0.5F);
}

TEST(FloatMapFile, FirstRowIsTheTopWhereTheCallerSaysSo) {
  EXPECT_EQ(parsed(by_hand, RowOrder::top_down).samples[0], 1.0F);
}

TEST(FloatMapFile, NanStaysWhereItIs) {
  const FloatMap map = parsed(by_hand);
  EXPECT_TRUE(std::isnan(map.samples[3]));
  EXPECT_EQ(map.samples[5], 0.0F);
}

TEST(FloatMapFile, PositiveScaleMeansMostSignificantByteFirst) {
  std::string swapped = "PF\n2 2\n1.0\n";
  const std::string samples = first_row + second_row;
  for (std::size_t i = 0; i < samples.size(); i += 4) {
    swapped.append(samples.rbegin() + static_cast<std::ptrdiff_t>(samples.size() - i - 4),
                   samples.rbegin() + static_cast<std::ptrdiff_t>(samples.size() - i));
  }
  const FloatMap map = parsed(swapped);
  EXPECT_EQ(map.samples[6], 1.0F);
  EXPECT_EQ(map.samples[8], 0.5F);
}

TEST(FloatMapFile, SizeOfTheScaleMovesNothing) {
  EXPECT_EQ(parsed("PF\n2 2\n-255\n" + first_row + second_row).samples[6], 1.0F);
}

TEST(FloatMapFile, HeaderMayStandOnOneLineOrEndInCarriageReturns) {
  EXPECT_EQ(parsed("PF 2 2 -1 " + first_row + second_row).samples[6], 1.0F);
  EXPECT_EQ(parsed("PF\r\n2 2\r\n-1.0\r\n" + first_row + second_row).samples[6], 1.0F);
}

TEST(FloatMapFile, IsWrittenAsItWasRead) {
  EXPECT_EQ(to_float_map_file(parsed(by_hand), RowOrder::bottom_up), by_hand);
  EXPECT_EQ(to_float_map_file(parsed(by_hand, RowOrder::top_down), RowOrder::top_down), by_hand);
}

TEST(FloatMapFile, OfOneComponentIsAnErrorThatSaysSo) {
  EXPECT_THAT(map_problem("Pf\n2 2\n-1.0\n" + zero), HasSubstr("one component"));
}

TEST(FloatMapFile, OfAnotherKindIsAnError) {
  EXPECT_THAT(map_problem("P6\n2 2\n255\n"), HasSubstr("is not a portable float map"));
  EXPECT_THAT(map_problem(""), HasSubstr("is not a portable float map"));
  EXPECT_THAT(map_problem("PF"), HasSubstr("without width, height and scale"));
}

TEST(FloatMapFile, NegativeTinyAndHugeSizesAreErrors) {
  EXPECT_THAT(map_problem("PF\n-2 2\n-1.0\n" + first_row), HasSubstr("-2 x 2"));
  EXPECT_THAT(map_problem("PF\n1 1\n-1.0\n" + one + one + one), HasSubstr("at least 2 x 2"));
  EXPECT_THAT(map_problem("PF\n2000000000 2000000000\n-1.0\n"), HasSubstr("use at most"));
  EXPECT_THAT(map_problem("PF\n99999999999999999999 2\n-1.0\n"), HasSubstr("header"));
}

TEST(FloatMapFile, TooFewOrTooManySamplesAreErrors) {
  EXPECT_THAT(map_problem(by_hand.substr(0, by_hand.size() - 1)),
              HasSubstr("47 bytes of samples, but 2 x 2 samples need 48"));
  EXPECT_THAT(map_problem(by_hand + "x"), HasSubstr("49 bytes"));
  EXPECT_THAT(map_problem("PF\n16384 2048\n-1.0\n" + first_row), HasSubstr("24 bytes"));
}

TEST(FloatMapFile, ScaleThatTellsNoByteOrderIsAnError) {
  for (const char* const scale : {"0", "nan", "inf", "-inf"}) {
    std::string bytes = "PF\n2 2\n";
    bytes.append(scale).append("\n").append(first_row).append(second_row);
    EXPECT_THAT(map_problem(bytes), HasSubstr("byte order"));
  }
}

}  // namespace
}  // namespace ergodome
