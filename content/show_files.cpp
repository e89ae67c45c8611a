#include "content/show_files.h"

#include <fmt/format.h>

namespace ergodome {

Error named_by(const Show& show, const std::string& key, const Error& error) {
  const auto line = show.lines.find(key);
  const std::string place = line == show.lines.end() ? "" : fmt::format(", {}.toml:{}", show.name, line->second);
  return {error.place(), fmt::format("{} ({}{})", error.problem(), key, place), error.remedy()};
}

}  // namespace ergodome
