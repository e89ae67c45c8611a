#include "app/idle_line_facts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "content/files/console.h"
#include "content/idle_lines.h"

namespace ergodome {

nlohmann::json facts_of_idle_lines(const Show& show) {
  nlohmann::json lines = nlohmann::json::array();
  for (const IdleLine& idle : idle_lines(show)) {
    lines.push_back({{"key", idle.key}, {"line", idle.line}, {"why", idle.why}});
  }
  return lines;
}

void print_idle_lines(const nlohmann::json& lines) {
  if (!lines.empty()) {
    print_out("\nlines that change nothing\n");
  }
  for (const nlohmann::json& idle : lines) {
    print_out("  {:>5}  {:<40} {}\n", idle["line"].get<int>(), idle["key"].get<std::string>(),
              idle["why"].get<std::string>());
  }
}

}  // namespace ergodome
