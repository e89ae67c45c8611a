#include "content/tables/number_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace ergodome {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr int digit_count = 17;
//! Numbers whose 17 digits follow from one exact product of 128 bits, and need no exponent.
constexpr double smallest_plain = 1e-4;
constexpr double largest_plain = 1e15;

//! Powers of five up to 5^20, for numbers from smallest_plain.
constexpr auto powers_of_five = [] {
  std::array<std::uint64_t, 21> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) {
    powers.at(i) = 5 * powers.at(i - 1);
  }
  return powers;
}();

//! Powers of ten from smallest_plain to largest_plain. None of these doubles is below the exact
//! power, so comparing with them yields the decimal exponent.
constexpr double powers_of_ten[] = {1e-4, 1e-3, 1e-2, 1e-1, 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,
                                    1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

constexpr auto pairs_of_digits = [] {
  std::array<char, 200> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs.at(i) = static_cast<char>('0' + (i % 2 == 0 ? i / 20 : i / 2 % 10));
  }
  return pairs;
}();

void write_eight_digits(char* to, std::uint32_t number) {
  for (int pair = 3; pair >= 0; --pair) {
    std::memcpy(to + 2 * pair, pairs_of_digits.data() + 2 * (number % 100), 2);
    number /= 100;
  }
}

//! A positive number as digits * 10^(exponent - 16), with 17 digits.
struct Decimal {
  std::uint64_t digits;
  int exponent;
};

//! Rounds a number from smallest_plain to largest_plain to 17 digits.
Decimal decimal_of(double number) {
  constexpr int mantissa_bits = 52;
  constexpr std::uint64_t one = std::uint64_t{1} << mantissa_bits;
  constexpr std::uint64_t too_many_digits = 100'000'000'000'000'000;
  const auto bits = std::bit_cast<std::uint64_t>(number);
  const int binary_exponent = static_cast<int>(bits >> mantissa_bits) - 1023;
  // 1233 / 4096 is slightly below log10(2), so the estimate is correct or too small by one.
  int exponent = (binary_exponent * 1233) >> 12;
  exponent += number >= powers_of_ten[exponent + 5] ? 1 : 0;
  // number * 10^power = mantissa * 5^power / 2^shift
  const int power = digit_count - 1 - exponent;
  const int shift = mantissa_bits - binary_exponent - power;
  const Wide product = Wide{(bits & (one - 1)) | one} * powers_of_five[static_cast<std::size_t>(power)];
  auto digits = static_cast<std::uint64_t>(product >> shift);
  const Wide rest = product - (Wide{digits} << shift);
  const Wide half = Wide{1} << (shift - 1);
  digits += rest > half || (rest == half && digits % 2 == 1) ? 1 : 0;
  return digits < too_many_digits ? Decimal{digits, exponent} : Decimal{digits / 10, exponent + 1};
}

//! Writes digits with a decimal point after the digit `exponent`, or with zeros before them.
char* write_decimal(char* to, const Decimal& number) {
  char digits[2 * digit_count] = {};
  const std::uint64_t tail = number.digits % 10'000'000'000'000'000;
  digits[0] = static_cast<char>('0' + number.digits / 10'000'000'000'000'000);
  write_eight_digits(digits + 1, static_cast<std::uint32_t>(tail / 100'000'000));
  write_eight_digits(digits + 9, static_cast<std::uint32_t>(tail % 100'000'000));
  int count = digit_count;
  while (count > 1 && digits[count - 1] == '0') {
    --count;
  }
  // Copies of a fixed length are fast; what they write beyond the end is not part of the text.
  const int whole = std::max(number.exponent + 1, 0);
  if (number.exponent < 0) {
    constexpr char zeros[] = {'0', '.', '0', '0', '0'};
    std::memcpy(to, zeros, sizeof zeros);
    std::memcpy(to + 1 - number.exponent, digits, digit_count);
    return to + 1 - number.exponent + count;
  }
  std::memcpy(to, digits, digit_count);
  to[whole] = '.';
  std::memcpy(to + whole + 1, digits + whole, digit_count);
  // The zeros of an integer are part of the number.
  return to + (count > whole ? count + 1 : whole);
}

}  // namespace

char* write_number(char* to, double value) {
  const double size = std::abs(value);
  if (size >= smallest_plain && size < largest_plain) {
    *to = '-';
    return write_decimal(to + (value < 0.0 ? 1 : 0), decimal_of(size));
  }
  if (std::bit_cast<std::uint64_t>(value) == 0) {
    *to = '0';
    return to + 1;
  }
  return std::to_chars(to, to + room_for_number, value, std::chars_format::general, 17).ptr;
}

}  // namespace ergodome
