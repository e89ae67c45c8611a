#include "content/tables/number_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace ergodome {

namespace {

//! Format of the numbers of a type: enough digits to identify each number. From `smallest` to `largest`, one exact product of
//! integers yields all digits.
template <class Real>
struct Writing;

template <>
struct Writing<double> {
  using Bits = std::uint64_t;
  __extension__ using Product = unsigned __int128;
  static constexpr int digit_count = 17;
  static constexpr double smallest = 1e-4;
  static constexpr double largest = 1e15;
};

template <>
struct Writing<float> {
  using Bits = std::uint32_t;
  using Product = std::uint64_t;
  static constexpr int digit_count = 9;
  static constexpr double smallest = 1e-9;
  static constexpr double largest = 1e6;
};

//! Powers of five up to 5^20, for numbers from Writing::smallest.
constexpr auto powers_of_five = [] {
  std::array<std::uint64_t, 21> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) {
    powers.at(i) = 5 * powers.at(i - 1);
  }
  return powers;
}();

constexpr int first_power_of_ten = -9;
//! Powers of ten, rounded to double. Comparing with them yields the decimal exponent, because no number to be written lies
//! between a power and its rounded value.
constexpr double powers_of_ten[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0,  1e1,  1e2, 1e3,
                                    1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

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

//! A positive number d.ddd... * 10^exponent; `digits` are its digits without the point.
struct Decimal {
  std::uint64_t digits;
  int exponent;
};

//! Rounds a number to Writing::digit_count digits. The number is in [smallest, largest).
template <class Real>
Decimal decimal_of(Real number) {
  using Product = typename Writing<Real>::Product;
  constexpr int mantissa_bits = std::numeric_limits<Real>::digits - 1;
  constexpr auto one = typename Writing<Real>::Bits{1} << mantissa_bits;
  constexpr std::uint64_t too_many_digits = Writing<Real>::digit_count == 17 ? 100'000'000'000'000'000 : 1'000'000'000;
  const auto bits = std::bit_cast<typename Writing<Real>::Bits>(number);
  const int binary_exponent = static_cast<int>(bits >> mantissa_bits) - (std::numeric_limits<Real>::max_exponent - 1);
  // 1233 / 4096 is close to log10(2), so the estimate is correct or too small by one.
  int exponent = (binary_exponent * 1233) >> 12;
  exponent += static_cast<double>(number) >= powers_of_ten[exponent + 1 - first_power_of_ten] ? 1 : 0;
  // number * 10^power = mantissa * 5^power / 2^shift
  const int power = Writing<Real>::digit_count - 1 - exponent;
  const int shift = mantissa_bits - binary_exponent - power;
  const Product product = Product{(bits & (one - 1)) | one} * powers_of_five[static_cast<std::size_t>(power)];
  auto digits = static_cast<std::uint64_t>(product >> shift);
  const Product rest = product - (Product{digits} << shift);
  const Product half = Product{1} << (shift - 1);
  digits += rest > half || (rest == half && digits % 2 == 1) ? 1 : 0;
  return digits < too_many_digits ? Decimal{digits, exponent} : Decimal{digits / 10, exponent + 1};
}

//! Writes 9 or 17 digits.
template <int digit_count>
void write_digits(char* to, std::uint64_t digits) {
  constexpr std::uint64_t first = digit_count == 17 ? 10'000'000'000'000'000 : 100'000'000;
  const std::uint64_t tail = digits % first;
  *to++ = static_cast<char>('0' + digits / first);
  if constexpr (digit_count == 17) {
    write_eight_digits(to, static_cast<std::uint32_t>(tail / 100'000'000));
    to += 8;
  }
  write_eight_digits(to, static_cast<std::uint32_t>(tail % 100'000'000));
}

//! Writes a number with `digit_count` digits, without the zeros at the end of its fraction.
template <int digit_count>
char* write_decimal(char* to, const Decimal& number) {
  char digits[2 * digit_count] = {};
  write_digits<digit_count>(digits, number.digits);
  int count = digit_count;
  while (count > 1 && digits[count - 1] == '0') {
    --count;
  }
  // Copies of a fixed length are fast; what they write beyond the end is not part of the text.
  if (number.exponent < -4) {
    to[0] = digits[0];
    to[1] = '.';
    std::memcpy(to + 2, digits + 1, digit_count - 1);
    char* const end = to + (count > 1 ? count + 1 : 1);
    constexpr char power[] = {'e', '-', '0'};
    std::memcpy(end, power, sizeof power);
    end[sizeof power] = static_cast<char>('0' - number.exponent);
    return end + sizeof power + 1;
  }
  if (number.exponent < 0) {
    constexpr char zeros[] = {'0', '.', '0', '0', '0'};
    std::memcpy(to, zeros, sizeof zeros);
    std::memcpy(to + 1 - number.exponent, digits, digit_count);
    return to + 1 - number.exponent + count;
  }
  const int whole = number.exponent + 1;
  std::memcpy(to, digits, digit_count);
  to[whole] = '.';
  std::memcpy(to + whole + 1, digits + whole, digit_count);
  // The zeros of an integer are part of the number.
  return to + (count > whole ? count + 1 : whole);
}

template <class Real>
char* write_real(char* to, Real value) {
  const auto size = static_cast<double>(std::abs(value));
  if (size >= Writing<Real>::smallest && size < Writing<Real>::largest) {
    *to = '-';
    return write_decimal<Writing<Real>::digit_count>(to + (value < 0 ? 1 : 0), decimal_of(std::abs(value)));
  }
  if (std::bit_cast<typename Writing<Real>::Bits>(value) == 0) {
    *to = '0';
    return to + 1;
  }
  return std::to_chars(to, to + room_for_number, value, std::chars_format::general, Writing<Real>::digit_count).ptr;
}

}  // namespace

char* write_number(char* to, double value) { return write_real(to, value); }

char* write_number(char* to, float value) { return write_real(to, value); }

}  // namespace ergodome
