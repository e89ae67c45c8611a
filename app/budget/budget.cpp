#include "app/budget/budget.h"

#include <fmt/format.h>

#include <charconv>

#include "app/cli/usage_error.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr const char* budget_remedy = "write, for example, --budget 0.25px, --budget 60fps or --budget 0.25px,60fps";

[[noreturn]] void refuse_budget(const std::string& word, const std::string& problem, const std::string& remedy) {
  throw UsageError(fmt::format("--budget {}", word), problem, remedy);
}

//! Splits words at commas and blanks; leaves out empty parts.
std::vector<std::string> budget_parts(const std::vector<std::string>& words) {
  std::vector<std::string> parts(1);
  for (const std::string& word : words) {
    for (const char letter : word) {
      if (letter == ',' || letter == ' ' || letter == '\t') {
        parts.emplace_back();
      } else {
        parts.back() += letter;
      }
    }
    parts.emplace_back();
  }
  std::erase(parts, std::string());
  return parts;
}

void set_once(std::optional<double>& value, double number, double minimum, double maximum, const std::string& part,
              const char* unit) {
  if (!(number >= minimum && number <= maximum)) {
    refuse_budget(part, "is out of range", fmt::format("choose from {0:g}{2} to {1:g}{2}", minimum, maximum, unit));
  }
  if (value) {
    refuse_budget(part, fmt::format("is a second budget in {}", unit), "remove one of them");
  }
  value = number;
}

}  // namespace

Budget parse_budget(const std::vector<std::string>& words) {
  Budget budget;
  const std::vector<std::string> parts = budget_parts(words);
  for (const std::string& part : parts) {
    double number = 0.0;
    const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), number);
    const std::string unit(end, part.data() + part.size());
    if (problem != std::errc() || (unit != "px" && unit != "fps")) {
      refuse_budget(part, "is neither an error in px nor a frame rate in fps", budget_remedy);
    }
    if (unit == "px") {
      set_once(budget.error_px, number, min_budget_px, max_budget_px, part, "px");
    } else {
      set_once(budget.frame_rate_hz, number, min_budget_fps, max_budget_fps, part, "fps");
    }
  }
  if (parts.empty() && !words.empty()) {
    refuse_budget("\"\"", "is empty", budget_remedy);
  }
  return budget;
}

std::string text_of(const Budget& budget) {
  const std::string error = budget.error_px ? fmt::format("{:g}px", *budget.error_px) : "";
  const std::string rate = budget.frame_rate_hz ? fmt::format("{:g}fps", *budget.frame_rate_hz) : "";
  return fmt::format("{}{}{}", error, error.empty() || rate.empty() ? "" : ",", rate);
}

}  // namespace ergodome
