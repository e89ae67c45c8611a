#include "app/budget/budget_option.h"

#include <CLI/CLI.hpp>

namespace ergodome {

void add_budget_option(CLI::App& command, std::vector<std::string>& words) {
  command
      .add_option(
          "--budget", words,
          "keep an error (0.25px), a frame rate (60fps) or both (0.25px,60fps); settings are measured and chosen "
          "at the start, in up to two seconds")
      ->allow_extra_args(false);
}

}  // namespace ergodome
