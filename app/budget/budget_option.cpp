#include "app/budget/budget_option.h"

#include <CLI/CLI.hpp>

namespace ergodome {

void add_budget_option(CLI::App& command, std::vector<std::string>& words) {
  command
      .add_option(
          "--budget", words,
          "what a frame may cost: 0.25px (error on the screen), 60fps (a frame's time), or 0.25px,60fps; settings are "
          "chosen by measuring at the start, in two seconds at the most")
      ->allow_extra_args(false);
}

}  // namespace ergodome
