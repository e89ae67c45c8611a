#include "content/show_files.h"

#include <fmt/format.h>

namespace ergodome {

Error named_by(const Show& show, const std::string& key, const Error& error) {
  std::string place = key;
  if (!show.name.empty()) {
    const auto line = show.lines.find(key);
    place += fmt::format(", {}.toml", show.name);
    place += line == show.lines.end() ? "" : fmt::format(":{}", line->second);
  }
  return {error.place(), fmt::format("{} ({})", error.problem(), place), error.remedy()};
}

}  // namespace ergodome
