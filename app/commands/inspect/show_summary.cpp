#include "app/commands/inspect/show_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "content/files/console.h"
#include "content/show/unused_keys.h"

namespace ergodome {

nlohmann::json summary_of_unused_keys(const Show& show) {
  nlohmann::json lines = nlohmann::json::array();
  for (const UnusedKey& idle : unused_keys(show)) {
    const nlohmann::json line = idle.line == key_set_outside ? nlohmann::json(nullptr) : nlohmann::json(idle.line);
    lines.push_back({{"key", idle.key}, {"line", line}, {"why", idle.why}});
  }
  return lines;
}

void print_unused_keys(const nlohmann::json& lines) {
  if (!lines.empty()) {
    print_out("\nunused keys\n");
  }
  for (const nlohmann::json& idle : lines) {
    const nlohmann::json& line = idle["line"];
    print_out("  {:>5}  {:<40} {}\n", line.is_null() ? show_setting_option : std::to_string(line.get<int>()),
              idle["key"].get<std::string>(), idle["why"].get<std::string>());
  }
}

}  // namespace ergodome
