#include "content/show/show_errors.h"

#include <fmt/format.h>

namespace ergodome {

std::string place_of(const Show& show, const std::string& key) {
  const auto line = show.lines.find(key);
  if (line == show.lines.end()) {
    return show.name + ".toml";
  }
  return line->second == key_set_outside ? show_setting_option : fmt::format("{}.toml:{}", show.name, line->second);
}

Error named_by(const Show& show, const std::string& key, const Error& error) {
  std::string place = key;
  if (!show.name.empty()) {
    place += ", " + place_of(show, key);
  }
  return {error.place(), fmt::format("{} ({})", error.problem(), place), error.remedy()};
}

void require_no_pipe(const std::filesystem::path& path) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(path.string(), "is not a regular file", "give the path of a file");
  }
}

}  // namespace ergodome
