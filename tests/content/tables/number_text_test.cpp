#include "content/tables/number_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace ergodome {
namespace {

//! Expects the text that fmt writes for a number and its negative.
void expect_text_of_fmt(double value) {
  for (const double number : {value, -value}) {
    std::string text;
    append_number(text, number);
    ASSERT_EQ(text, fmt::format("{:.17g}", number));
  }
}

TEST(NumberText, IsThatOfFmtForNumbersOfAnySize) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  for (int i = 0; i < 50'000; ++i) {
    expect_text_of_fmt(std::pow(10.0, exponent(random)));
    expect_text_of_fmt(std::bit_cast<double>(random()));
  }
}

TEST(NumberText, IsThatOfFmtForNumbersWithFewDigits) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> numerator(0, 1'000'000);
  std::uniform_int_distribution<int> power(0, 30);
  for (int i = 0; i < 50'000; ++i) {
    expect_text_of_fmt(numerator(random));
    expect_text_of_fmt(numerator(random) / 1000.0);
    expect_text_of_fmt(std::ldexp(numerator(random), -power(random)));  // ties of the 17th digit
  }
}

TEST(NumberText, IsThatOfFmtNextToPowersOfTen) {
  for (int power = -20; power <= 20; ++power) {
    double below = std::pow(10.0, power);
    double above = below;
    for (int i = 0; i < 10; ++i) {
      expect_text_of_fmt(below);
      expect_text_of_fmt(above);
      below = std::nextafter(below, 0.0);
      above = std::nextafter(above, 1e300);
    }
  }
}

TEST(NumberText, IsThatOfFmtForExtremeAndSpecialNumbers) {
  using Limits = std::numeric_limits<double>;
  for (const double number : {0.0, Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity(),
                              Limits::quiet_NaN(), static_cast<double>(0.1F)}) {
    expect_text_of_fmt(number);
  }
}

}  // namespace
}  // namespace ergodome
