#include "content/images/formats/radiance_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <vector>

namespace ergodome {

namespace {

//! Returns the numbers after the equals sign of a header line.
std::vector<double> numbers_of(std::string_view line) {
  std::istringstream text{std::string(line.substr(line.find('=') + 1))};
  text.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number = 0.0; numbers.size() < 8 && text >> number;) {
    numbers.push_back(number);
  }
  return numbers;
}

//! Returns true if the red, green and blue primaries are those of sRGB or Radiance's default ones,
//! which differ by 0.01 in green.
bool are_usual_primaries(const std::vector<double>& primaries) {
  constexpr std::array<double, 6> usual = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06};
  constexpr double tolerance = 0.0101;
  bool alike = true;
  for (std::size_t i = 0; alike && i < usual.size(); ++i) {
    alike = std::abs(primaries[i] - usual.at(i)) <= tolerance;
  }
  return alike;
}

void take_primaries(const std::vector<double>& primaries, RadianceHeader& header) {
  if (primaries.size() != 8) {
    header.problem = "its PRIMARIES are not eight numbers";
  } else if (!are_usual_primaries(primaries)) {
    header.primaries.emplace();
    std::ranges::copy(primaries, header.primaries->begin());
  }
}

void divide(RadianceHeader& header, std::size_t channel, double factor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    header.problem = "it has an EXPOSURE or COLORCORR that is not a positive number";
    return;
  }
  header.gains.at(channel) = static_cast<float>(header.gains.at(channel) / factor);
}

void take_line(std::string_view line, RadianceHeader& header) {
  if (line.starts_with("FORMAT=") && line.find("xyze") != std::string_view::npos) {
    header.is_xyz = true;
  } else if (line.starts_with("PRIMARIES=")) {
    take_primaries(numbers_of(line), header);
  } else if (line.starts_with("EXPOSURE=")) {
    const std::vector<double> numbers = numbers_of(line);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      divide(header, channel, numbers.empty() ? 0.0 : numbers.front());
    }
  } else if (line.starts_with("COLORCORR=")) {
    const std::vector<double> numbers = numbers_of(line);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      divide(header, channel, numbers.size() < 3 ? 0.0 : numbers[channel]);
    }
  }
}

}  // namespace

RadianceHeader read_radiance_header(std::string_view head) {
  RadianceHeader header;
  if (!head.starts_with("#?")) {
    return header;
  }
  while (!head.empty() && header.problem.empty()) {
    const std::size_t end = head.find('\n');
    const std::string_view line = head.substr(0, end);
    if (end == std::string_view::npos || line.empty()) {
      break;
    }
    take_line(line, header);
    head.remove_prefix(end + 1);
  }
  if (header.is_xyz) {
    constexpr double third = 1.0 / 3.0;
    header.primaries = {1.0, 0.0, 0.0, 1.0, 0.0, 0.0, third, third};
  }
  return header;
}

}  // namespace ergodome
