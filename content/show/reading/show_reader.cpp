#include "content/show/reading/show_reader.h"

#include <fmt/format.h>

#include <sstream>

#include "content/files/toml_table.h"
#include "content/files/whole_file.h"
#include "content/objects/object_checks.h"
#include "content/show/key_table.h"
#include "content/show/reading/animation_reader.h"
#include "content/show/reading/camera_reader.h"
#include "content/show/reading/fall_reader.h"
#include "content/show/reading/show_settings.h"
#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_mib = 16;

//! Reads the parts that depend on others, and checks what depends on the whole show.
void read_dependent_parts(TomlTable& root, const std::string& file, Show& show) {
  for (ObjectSettings& object : show.objects) {
    if (object.orbit) {
      object.orbit->spacetime = spacetime_of(show);
    }
  }
  read_fall(root.table("camera"), file, show);
  // Animations need the limits of the numbers read above, and reading the camera needs the animated
  // spin.
  read_animations(root, file, show);
  read_camera(root.table("camera"), file, show);
  check_spin_on_path(file, show);
  check_objects(root, show);
  if (const toml::table* const disk = root.table("disk")) {
    check_disk(*disk, file, show);
  }
  check_shells(root, file, show);
  check_sights_within(root, file, show);
}

//! Returns the line of a node; key_set_outside if it is not from the file.
int line_in(const std::string& file, const toml::node& node) {
  return is_from(node.source(), file) ? static_cast<int>(node.source().begin.line) : key_set_outside;
}

//! Records the lines of the keys in an array of tables ("shells[1].texture").
void note_tables(const toml::array& tables, const std::string& path, const std::string& file,
                 std::map<std::string, int>& lines) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (const toml::table* table = tables[i].as_table()) {
      for (const auto& [key, node] : *table) {
        lines[fmt::format("{}[{}].{}", path, i, key.str())] = line_in(file, node);
      }
    }
  }
}

//! Records the lines of the keys of a table, of the tables below it, and, if `path` is empty, of
//! its arrays of tables. Stops at a number of keys that no valid show has.
void note_lines(const toml::table& table, const std::string& path, const std::string& file,
                std::map<std::string, int>& lines) {
  constexpr std::size_t max_lines = 100'000;
  for (const auto& [key, node] : table) {
    if (lines.size() >= max_lines) {
      return;
    }
    const std::string own = path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str());
    lines[own] = line_in(file, node);
    if (const toml::table* below = node.as_table()) {
      note_lines(*below, own, file, lines);
    } else if (const toml::array* several = node.as_array(); several != nullptr && path.empty()) {
      note_tables(*several, own, file, lines);
    }
  }
}

}  // namespace

Show parse_show(std::string_view text, const std::string& file, const ShowSettings& settings) {
  toml::table parsed = parse_toml(text, file, largest_mib, "a show");
  apply_settings(parsed, settings, file);
  Show show;
  note_lines(parsed, "", file, show.lines);
  const std::filesystem::path path(file);
  show.name = path.stem().string();
  show.folder = path.parent_path().string();
  TomlTable root(parsed, file, "");
  read_keys(show_keys(), root, &show);
  read_dependent_parts(root, file, show);
  root.refuse_unknown_keys();
  return show;
}

Show read_show(const std::filesystem::path& path) { return read_show_with_settings(path, {}); }

Show read_show_with_settings(const std::filesystem::path& path, const ShowSettings& settings) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "does not exist or is not a regular file", "give the path of a show (.toml)");
  }
  return parse_show(read_whole_file(path, largest_mib << 20U, "a show is a small text file; check the path"),
                    path.string(), settings);
}

std::string to_toml(const Show& show) {
  std::ostringstream text;
  text << written_keys(show_keys(), &show) << '\n';
  return text.str();
}

}  // namespace ergodome
