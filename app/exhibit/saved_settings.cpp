#include "app/exhibit/saved_settings.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "content/files/atomic_file.h"
#include "content/files/toml_table.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_mib = 1;

SavedSettings parse(const std::string& text, const std::string& file) {
  const toml::table parsed = parse_toml(text, file, largest_mib, "the exhibit's settings file");
  TomlTable root(parsed, file, "");
  SavedSettings settings;
  settings.exposure_stops = root.number("exposure_stops", settings.exposure_stops, -20.0, 20.0);
  settings.baseline = root.number("baseline", settings.baseline, -1.0, 1e6);
  settings.volume = root.number("volume", settings.volume, 0.0, 1.0);
  settings.language = root.text("language", "");
  settings.captions = root.boolean("captions", true);
  root.refuse_unknown_keys();
  return settings;
}

}  // namespace

std::filesystem::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::filesystem::path(state) / "ergodome";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') {
    // A service may run without HOME, so the user database is asked. /tmp would not do: others can
    // write to it and plant links.
    const passwd* const user = ::getpwuid(::geteuid());
    home = user != nullptr ? user->pw_dir : nullptr;
  }
  return home != nullptr && *home == '/' ? std::filesystem::path(home) / ".local" / "state" / "ergodome"
                                         : std::filesystem::path();
}

SavedSettings read_saved_settings(const std::filesystem::path& file, std::string& problem) {
  problem.clear();
  remove_abandoned_files(file.parent_path());
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) {
    return {};
  }
  try {
    return parse(read_whole_file(file, largest_mib << 20U, "the exhibit's settings file is a short text file"),
                 file.string());
  } catch (const std::exception& error) {
    std::filesystem::rename(file, file.string() + ".bad", failure);
    problem = fmt::format("{} (renamed to {}.bad)", error.what(), file.filename().string());
    return {};
  }
}

void write_saved_settings(const std::filesystem::path& file, const SavedSettings& settings) {
  toml::table table{{"exposure_stops", settings.exposure_stops},
                    {"baseline", settings.baseline},
                    {"volume", settings.volume},
                    {"language", settings.language},
                    {"captions", settings.captions}};
  std::ostringstream text;
  text << table << "\n";
  make_folder(file.parent_path());
  write_text_atomically(file, text.str());
}

}  // namespace ergodome
