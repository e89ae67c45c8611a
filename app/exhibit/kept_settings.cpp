#include "app/exhibit/kept_settings.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "content/files/atomic_file.h"
#include "content/files/toml_table.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_mib = 1;

KeptSettings parse(const std::string& text, const std::string& file) {
  const toml::table parsed = parse_toml(text, file, largest_mib, "kept settings");
  TomlTable root(parsed, file, "");
  KeptSettings settings;
  settings.exposure_stops = root.number("exposure_stops", settings.exposure_stops, -20.0, 20.0);
  settings.baseline = root.number("baseline", settings.baseline, -1.0, 1e6);
  settings.volume = root.number("volume", settings.volume, 0.0, 1.0);
  settings.language = root.text("language", "");
  settings.captions = root.boolean("captions", true);
  root.refuse_unknown_keys();
  return settings;
}

//! A program that is killed while it writes leaves the part that it wrote beside the file.
void remove_partial_files(const std::filesystem::path& named) {
  std::filesystem::path file;
  try {
    file = behind_links(named);
  } catch (const Error&) {
    return;  // A link that leads nowhere has nothing beside what it names.
  }
  std::error_code ignored;
  for (const auto& each : std::filesystem::directory_iterator(file.parent_path(), ignored)) {
    const std::string name = each.path().filename().string();
    if (name.starts_with(".partial-") && name.ends_with(fmt::format("-{}", file.filename().string()))) {
      std::filesystem::remove(each.path(), ignored);
    }
  }
}

}  // namespace

std::filesystem::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::filesystem::path(state) / "ergodome";
  }
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr && *home == '/' ? home : "/tmp") / ".local" / "state" / "ergodome";
}

KeptSettings read_kept_settings(const std::filesystem::path& file, std::string& problem) {
  problem.clear();
  remove_partial_files(file);
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) {
    return {};
  }
  try {
    return parse(read_whole_file(file, largest_mib << 20U, "settings are a short text file"), file.string());
  } catch (const std::exception& error) {
    std::filesystem::rename(file, file.string() + ".bad", failure);
    problem = fmt::format("{} (it is {}.bad now)", error.what(), file.filename().string());
    return {};
  }
}

void write_kept_settings(const std::filesystem::path& file, const KeptSettings& settings) {
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
