#include "content/show/show_reader.h"

#include <fmt/format.h>

#include "content/camera/camera_reader.h"
#include "content/fall/fall_reader.h"
#include "content/files/toml_table.h"
#include "content/files/whole_file.h"
#include "content/objects/object_reader.h"
#include "content/show/disk_reader.h"
#include "content/show/key_table.h"
#include "content/show/own_number.h"
#include "content/show/shell_reader.h"
#include "content/show/show_schema.h"
#include "content/show/show_settings.h"
#include "content/show/view_reader.h"
#include "content/sky/map_layout_reader.h"
#include "content/sky/sky_map.h"
#include "content/timeline/frame_rate.h"
#include "content/timeline/timeline_reader.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_mib = 16;

void read_sky(const toml::table& table, const std::string& file, SkySettings& sky) {
  TomlTable reader(table, file, "sky");
  sky.map = reader.text("map", sky.map);
  if (const toml::table* layout = reader.table("map_layout")) {
    if (is_built_in_sky(sky.map)) {
      throw reader.error_at("map_layout", "cannot be used with the built-in map \"" + sky.map + "\"",
                            "remove it, or give the path of an image as map");
    }
    sky.map_layout = read_map_layout(*layout, file);
  }
  sky.stars = reader.text("stars", sky.stars);
  sky.faintest_mag = own_number(reader, "faintest_mag", sky.faintest_mag);
  sky.exposure = own_number(reader, "exposure", sky.exposure);
  sky.filter = static_cast<SkyFilter>(reader.choice("filter", 0, {"ewa", "point", "polygon"}));
  constexpr SkyShift shifts[] = {SkyShift::luminance, SkyShift::blackbody_fit};
  sky.shift = shifts[reader.choice("shift", 0, {"luminance", "blackbody_fit"})];
  sky.brightening = reader.boolean("brightening", false);
  if (const toml::table* axis = reader.table("spin_axis")) {
    TomlTable direction(*axis, file, "sky.spin_axis");
    sky.spin_axis_ra_deg = own_number(direction, "ra_deg", sky.spin_axis_ra_deg);
    sky.spin_axis_dec_deg = own_number(direction, "dec_deg", sky.spin_axis_dec_deg);
    direction.refuse_unknown_keys();
  }
  reader.refuse_unknown_keys();
}

void read_parts(TomlTable& root, const std::string& file, Show& show) {
  const auto part = [&](std::string_view key, auto read) {
    if (const toml::table* table = root.table(key)) {
      read(*table);
    }
  };
  part("sky", [&](const toml::table& table) { read_sky(table, file, show.sky); });
  part("stars", [&](const toml::table& table) {
    TomlTable stars(table, file, "stars");
    show.sky.star_method = static_cast<StarMethod>(stars.choice("method", 0, {"inverse", "gather"}));
    stars.refuse_unknown_keys();
  });
  part("disk", [&](const toml::table& table) { show.disk = read_disk(table, file); });
  show.shells = read_shells(root, file);
  read_some_keys(show_keys(), root, &show);
  part("view", [&](const toml::table& table) { read_view(table, file, show.view); });
  read_objects(root, file, show);
  read_fall(root.table("camera"), file, show);
  // The timeline needs the limits of these numbers, and the camera the animated spin.
  read_timeline(root, file, show);
  read_camera(root.table("camera"), file, show);
  check_spin_on_path(file, show);
  check_objects(root, show);
  part("disk", [&](const toml::table& table) { check_disk(table, file, show); });
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

//! Records the line of each key of a table. Stops at a number of keys that no valid show has.
void note_lines(const toml::table& table, const std::string& path, const std::string& file,
                std::map<std::string, int>& lines) {
  constexpr std::size_t most_lines = 100'000;
  for (const auto& [key, node] : table) {
    if (lines.size() >= most_lines) {
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

//! Reads the title, which must fit one line in every language.
LocalText read_title(TomlTable& root, const std::string& file, const std::string& otherwise) {
  const toml::node* const node = root.node("title");
  if (node == nullptr || !node->is_table()) {
    return {{"", root.text("title", otherwise)}};
  }
  LocalText title = read_local_text(root, file, "title");
  TomlTable languages(*node->as_table(), file, "title");
  for (const auto& [tag, words] : title) {
    languages.text(tag, "");
  }
  return title;
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
  show.title = read_title(root, file, show.name);
  show.duration_s = root.number("duration_s", 0.0, 0.0, 1e9);
  show.frame_rate_hz = exact_rate_hz(root.number("frame_rate_hz", 30.0, 0.001, 1000.0));
  read_parts(root, file, show);
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

}  // namespace ergodome
