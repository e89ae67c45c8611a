#include "app/cli/option_checks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "app/cli/usage_error.h"
#include "content/timeline/frame_rate.h"
#include "kernels/core/error.h"

namespace ergodome {

double pixels_of(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  const std::string unit = text.substr(used);
  if (used == 0 || !(unit.empty() || unit == "px") || !(value >= 1e-4 && value <= 100.0)) {
    throw UsageError(option + " " + text, "is not a number of pixels",
                     "write for example " + option + " 0.1px, from 1e-4 to 100");
  }
  return value;
}

CLI::Validator one_of(std::span<const char* const> names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

CLI::Validator number_between(double minimum, double maximum) {
  return {[minimum, maximum](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= minimum && value <= maximum;
            return good ? std::string()
                        : fmt::format("\"{}\" is not a number from {:g} to {:g}", text, minimum, maximum);
          },
          fmt::format("FLOAT in [{:g} - {:g}]", minimum, maximum)};
}

CLI::Validator frame_rate_between(double minimum, double maximum) {
  return {[minimum, maximum](std::string& text) {
            const std::size_t slash = text.find('/');
            double frames = 0.0;
            double seconds = 1.0;
            const bool good =
                CLI::detail::lexical_cast(text.substr(0, slash), frames) &&
                (slash == std::string::npos || CLI::detail::lexical_cast(text.substr(slash + 1), seconds)) &&
                frames / seconds >= minimum && frames / seconds <= maximum;
            if (!good) {
              return fmt::format("\"{}\" is not a number from {:g} to {:g}, nor a fraction like 30000/1001", text,
                                 minimum, maximum);
            }
            text = fmt::format("{:.17g}", exact_rate_hz(frames / seconds));
            return std::string();
          },
          fmt::format("FLOAT in [{:g} - {:g}]", minimum, maximum)};
}

CLI::Validator show_time() { return number_between(-1e12, 1e12); }

void IgnoredOptions::add(const char* where, std::function<bool()> holds, std::initializer_list<const char*> options) {
  Rule rule{where, std::move(holds), {}};
  for (const char* const option : options) {
    rule.options.push_back(command_->get_option(option));
  }
  rules_.push_back(std::move(rule));
}

void IgnoredOptions::refuse() const {
  for (const Rule& rule : rules_) {
    const auto given = std::ranges::find_if(rule.options, [](const CLI::Option* each) { return each->count() > 0; });
    if (given != rule.options.end() && rule.holds()) {
      throw CLI::ValidationError((*given)->get_name(), fmt::format("has no effect {}; leave it out", rule.where));
    }
  }
}

}  // namespace ergodome
