#include "content/show/show_errors.h"

#include <fmt/format.h>

namespace ergodome {

std::string location_of(const Show& show, const std::string& key) {
  const auto line = show.lines.find(key);
  if (line == show.lines.end()) {
    return show.name + ".toml";
  }
  return line->second == key_set_outside ? show_setting_option : fmt::format("{}.toml:{}", show.name, line->second);
}

Error named_by(const Show& show, const std::string& key, const Error& error) {
  std::string location = key;
  if (!show.name.empty()) {
    location += ", " + location_of(show, key);
  }
  return {error.location(), fmt::format("{} ({})", error.problem(), location), error.remedy()};
}

void require_no_pipe(const std::filesystem::path& path) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(path.string(), "is not a regular file", "give the path of a file");
  }
}

}  // namespace ergodome
