#include "app/cli/idle_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

namespace ergodome {

void IdleOptions::add(const char* where, std::function<bool()> holds, std::initializer_list<const char*> options) {
  Rule rule{where, std::move(holds), {}};
  for (const char* const option : options) {
    rule.options.push_back(command_->get_option(option));
  }
  rules_.push_back(std::move(rule));
}

void IdleOptions::refuse() const {
  for (const Rule& rule : rules_) {
    const auto given = std::ranges::find_if(rule.options, [](const CLI::Option* each) { return each->count() > 0; });
    if (given != rule.options.end() && rule.holds()) {
      throw CLI::ValidationError((*given)->get_name(), fmt::format("has no effect {}; leave it out", rule.where));
    }
  }
}

}  // namespace ergodome
