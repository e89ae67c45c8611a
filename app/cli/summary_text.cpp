#include "app/cli/summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ergodome {

namespace {

//! Rounds to two significant digits, or to an integer from 10 on; without an exponent.
std::string rounded(double number) {
  return number >= 9.95 ? fmt::format("{:.0f}", number) : fmt::format("{:.2g}", number);
}

}  // namespace

std::string grouped(long count) {
  std::string digits = std::to_string(count);
  for (std::size_t end = digits.size(); end > 3;) {
    end -= 3;
    digits.insert(end, ",");
  }
  return digits;
}

std::string size_text(std::uintmax_t bytes) {
  constexpr std::array units = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (size >= 999.5 && unit + 1 < units.size()) {
    size /= 1000.0;
    ++unit;
  }
  return fmt::format("{} {}", unit == 0 ? std::to_string(bytes) : rounded(size), units[unit]);
}

std::string duration_text(double seconds) {
  if (seconds < 59.5) {
    return seconds < 0.01 ? "10 ms or less" : rounded(seconds) + " s";
  }
  const auto minutes = static_cast<long>(std::min(std::round(seconds / 60.0), 1e15));
  const auto two = [](long large, const char* large_unit, long small, const char* small_unit) {
    return small == 0 ? fmt::format("{} {}", grouped(large), large_unit)
                      : fmt::format("{} {} {} {}", grouped(large), large_unit, small, small_unit);
  };
  constexpr long hour = 60;
  constexpr long day = 24 * hour;
  if (minutes < hour) {
    return fmt::format("{} min", minutes);
  }
  return minutes < day ? two(minutes / hour, "h", minutes % hour, "min")
                       : two(minutes / day, "d", minutes % day / hour, "h");
}

std::string json_text(const nlohmann::json& summary) {
  return summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ergodome
