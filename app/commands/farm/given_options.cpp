#include "app/commands/farm/given_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace ergodome {

std::vector<std::string> given_options(const CLI::App& command, const std::vector<std::string>& left_out) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || option->get_positional() || std::ranges::find(left_out, name) != left_out.end()) {
      continue;
    }
    if (option->get_type_size() == 0) {
      words.push_back(name);
      continue;
    }
    for (const std::string& value : option->results()) {
      words.push_back(fmt::format("{}={}", name, value));
    }
  }
  return words;
}

}  // namespace ergodome
