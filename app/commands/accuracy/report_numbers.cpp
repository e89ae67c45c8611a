#include "app/commands/accuracy/report_numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace ergodome {

std::string short_number(double value) {
  if (!std::isfinite(value)) {
    return "-";
  }
  const double size = std::abs(value);
  if (size == 0.0) {
    return "0";
  }
  if (size >= 9.995) {
    return size < 99'999.5 ? fmt::format("{:.0f}", value) : fmt::format("{:.1e}", value);
  }
  return size >= 0.9995 ? fmt::format("{:.1f}", value) : fmt::format("{:.2g}", value);
}

std::string error_number(const AccuracyAxis& axis, double error) {
  // Below a millionth of a percent, light differs only by the rounding of floats.
  const bool none = axis.unit == ErrorUnit::light && error < 1e-8;
  return short_number(none ? 0.0 : axis.unit == ErrorUnit::light ? 100.0 * error : error);
}

std::string error_text(const AccuracyAxis& axis, double error) {
  std::string text = error_number(axis, error);
  text += axis.unit == ErrorUnit::light ? " %" : " px";
  return text;
}

std::string spread_text(const Spread& spread) {
  return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.least),
                     short_number(spread.greatest));
}

std::string bytes_text(std::size_t bytes) {
  const auto number = static_cast<double>(bytes);
  return number < 1e6 ? fmt::format("{:.0f} kB", 1e-3 * number) : fmt::format("{:.1f} MB", 1e-6 * number);
}

std::string choice_name(const Measurement& choice) {
  std::string name = choice.method;
  for (const std::string* const part : {&choice.setting, &choice.precision}) {
    if (!part->empty()) {
      name += ", ";
      name += *part;
    }
  }
  return name;
}

}  // namespace ergodome
