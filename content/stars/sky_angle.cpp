#include "content/stars/sky_angle.h"

#include <charconv>
#include <cmath>
#include <span>

namespace ergodome {

namespace {

//! Marks after the parts, in the encodings that occur in tables; a lone \xB0 is the degree sign of
//! Latin-1.
constexpr std::string_view hour_marks[] = {"h", "H", "\u02B0"};
constexpr std::string_view degree_marks[] = {"d", "D", "\u00B0", "\u00BA", "\u02DA", "\xB0"};
constexpr std::string_view minute_marks[] = {"m", "M", "'", "\u2032", "\u2019", "\u1D50", ":"};
constexpr std::string_view second_marks[] = {"s", "S", "\"", "''", "\u2033", "\u201D", "\u02E2"};
constexpr std::string_view colons[] = {":"};
constexpr std::string_view minus_signs[] = {"-", "\u2212", "\u2013"};

bool take_one(std::string_view& text, std::span<const std::string_view> marks) {
  for (const std::string_view mark : marks) {
    if (text.starts_with(mark)) {
      text.remove_prefix(mark.size());
      return true;
    }
  }
  return false;
}

bool skip_spaces(std::string_view& text) {
  const std::size_t before = text.size();
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  return text.size() != before;
}

//! Takes a number without a sign or an exponent from the beginning of the text.
std::optional<double> take_part(std::string_view& text) {
  if (text.empty() || text.front() < '0' || text.front() > '9') {
    return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc()) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

//! Takes the mark or spaces after part `index`. Returns false if the next characters are neither,
//! or are a mark of another part. At the end of the text, neither is needed.
bool take_mark(std::string_view& text, int index, SkyAngle& angle) {
  const bool spaces = skip_spaces(text);
  bool marked = false;
  if (index == 0 && take_one(text, hour_marks)) {
    angle.mark = AngleMark::hours;
    marked = true;
  } else if (index == 0 && take_one(text, degree_marks)) {
    angle.mark = AngleMark::degrees;
    marked = true;
  } else if (index == 0) {
    marked = take_one(text, colons);
  } else {
    marked = index == 1 ? take_one(text, minute_marks) : take_one(text, second_marks);
  }
  skip_spaces(text);
  return spaces || marked || text.empty();
}

std::optional<double> plain_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<SkyAngle> parse_sky_angle(std::string_view text) {
  skip_spaces(text);
  while (text.ends_with(' ')) {
    text.remove_suffix(1);
  }
  const bool negative = take_one(text, minus_signs);
  if (!negative && text.starts_with('+')) {
    text.remove_prefix(1);
  }
  skip_spaces(text);
  const double sign = negative ? -1.0 : 1.0;
  SkyAngle angle;
  if (text.empty() || text.front() == '-') {
    return std::nullopt;
  }
  if (const auto plain = plain_number(text)) {
    angle.value = sign * *plain;
    return angle;
  }
  double unit = 1.0;
  for (int index = 0; index < 3 && !text.empty(); ++index, unit /= 60.0) {
    const auto part = take_part(text);
    const bool ends_with_colon = text == ":";
    if (!part || ends_with_colon || !take_mark(text, index, angle)) {
      return std::nullopt;
    }
    const bool whole = *part == std::floor(*part);
    if ((index > 0 && *part > 60.0) || (index == 1 && *part == 60.0) || (!text.empty() && !whole)) {
      return std::nullopt;
    }
    angle.value += unit * *part;
    angle.sexagesimal = angle.sexagesimal || index > 0;
  }
  if (!text.empty()) {
    return std::nullopt;
  }
  angle.value *= sign;
  return angle;
}

}  // namespace ergodome
