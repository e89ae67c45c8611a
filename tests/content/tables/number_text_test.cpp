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
template <class Real>
void expect_text_of_fmt(Real value) {
  constexpr int digits = std::numeric_limits<Real>::max_digits10;
  for (const Real number : {value, -value}) {
    std::string text;
    append_number(text, number);
    ASSERT_EQ(text, fmt::format("{:.{}g}", static_cast<double>(number), digits));
  }
}

//! Expects the text of fmt for a number and its ten neighbors on both sides.
template <class Real>
void expect_text_of_fmt_around(Real number) {
  Real below = number;
  Real above = number;
  for (int i = 0; i < 10; ++i) {
    expect_text_of_fmt(below);
    expect_text_of_fmt(above);
    below = std::nextafter(below, Real{0});
    above = std::nextafter(above, std::numeric_limits<Real>::max());
  }
}

TEST(NumberText, IsThatOfFmtForNumbersOfAnySize) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  for (int i = 0; i < 50'000; ++i) {
    expect_text_of_fmt(std::pow(10.0, exponent(random)));
    expect_text_of_fmt(std::bit_cast<double>(random()));
    expect_text_of_fmt(static_cast<float>(std::pow(10.0, exponent(random))));
    expect_text_of_fmt(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  }
}

TEST(NumberText, IsThatOfFmtForNumbersWithFewDigits) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> numerator(0, 1'000'000);
  std::uniform_int_distribution<int> power(0, 30);
  for (int i = 0; i < 50'000; ++i) {
    expect_text_of_fmt(static_cast<double>(numerator(random)));
    expect_text_of_fmt(static_cast<float>(numerator(random)));
    expect_text_of_fmt(numerator(random) / 1000.0);
    expect_text_of_fmt(static_cast<float>(numerator(random)) / 1000.0F);
    const double tie = std::ldexp(numerator(random), -power(random));  // may lie halfway between two decimals
    expect_text_of_fmt(tie);
    expect_text_of_fmt(static_cast<float>(tie));
  }
}

TEST(NumberText, IsThatOfFmtNextToPowersOfTen) {
  for (int power = -20; power <= 20; ++power) {
    expect_text_of_fmt_around(std::pow(10.0, power));
    expect_text_of_fmt_around(std::pow(10.0F, static_cast<float>(power)));
  }
}

TEST(NumberText, IsThatOfFmtForExtremeAndSpecialNumbers) {
  using Limits = std::numeric_limits<double>;
  for (const double number : {0.0, Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity(),
                              Limits::quiet_NaN(), static_cast<double>(0.1F)}) {
    expect_text_of_fmt(number);
    expect_text_of_fmt(static_cast<float>(number));
  }
  expect_text_of_fmt(std::numeric_limits<float>::denorm_min());
  expect_text_of_fmt(std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace ergodome
