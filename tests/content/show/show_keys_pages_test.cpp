#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "content/files/whole_file.h"
#include "content/show/show_schema.h"
#include "kernels/core/angles.h"

// The tables of keys in the reference pages must agree with the list of keys in the program. If the
// environment variable ERGODOME_RENEW_REFERENCES is set, the tests write the tables into the pages
// instead of comparing them.
namespace ergodome {
namespace {

//! Returns a number as the pages write it: 1e6, not 1e+06.
std::string page_number(double value) {
  std::string text = fmt::format("{:g}", value);
  if (const std::string power = fmt::format("{:.0e}", value); std::abs(value) >= 1e5 && std::stod(power) == value) {
    text = power;
  }
  for (const auto& [from, to] : {std::pair{"e+0", "e"}, {"e+", "e"}, {"e-0", "e-"}}) {
    if (const std::size_t at = text.find(from); at != std::string::npos) {
      text.replace(at, std::strlen(from), to);
    }
  }
  return text;
}

std::string type_on_page(const ShowKey& key) {
  constexpr const char* types[] = {
      "number", "integer",        "Boolean", "string", "text", "word", "list of 3 numbers", "list of 3 numbers",
      "table",  "list of tables", "",        ""};
  return key.page.type.empty() ? types[static_cast<std::size_t>(key.kind)] : std::string(key.page.type);
}

//! Returns the default of a key as the pages write it. `value` points to the key's value in
//! default-constructed settings; nullptr if there is none.
std::string default_on_page(const ShowKey& key, const void* value) {
  if (!key.page.otherwise.empty()) {
    return std::string(key.page.otherwise);
  }
  if (key.missing != nullptr || key.kind == KeyKind::local_text) {
    return "required";
  }
  if (value == nullptr || key.kind == KeyKind::table) {
    return "absent";
  }
  switch (key.kind) {
    case KeyKind::number:
      return page_number((key.degrees ? radian_deg : 1.0) * *static_cast<const double*>(value));
    case KeyKind::integer:
      return std::to_string(*static_cast<const int*>(value));
    case KeyKind::boolean:
      return *static_cast<const bool*>(value) ? "`true`" : "`false`";
    case KeyKind::text:
      return fmt::format("`\"{}\"`", *static_cast<const std::string*>(value));
    case KeyKind::color: {
      const auto& color = *static_cast<const std::array<double, 3>*>(value);
      return fmt::format("`[{:g}, {:g}, {:g}]`", color[0], color[1], color[2]);
    }
    case KeyKind::vector: {
      const auto& v = *static_cast<const Vector3<double>*>(value);
      return fmt::format("`[{:g}, {:g}, {:g}]`", v.x, v.y, v.z);
    }
    default: {
      std::int32_t word = 0;
      std::memcpy(&word, value, sizeof(word));
      return fmt::format("`\"{}\"`", key.words[static_cast<std::size_t>(word - key.first_word)]);
    }
  }
}

std::string range_on_page(const ShowKey& key) {
  if (!key.page.bounds.empty()) {
    return std::string(key.page.bounds);
  }
  if (key.limits.minimum < key.limits.maximum) {
    return fmt::format("{} to {}{}", page_number(key.limits.minimum), page_number(key.limits.maximum),
                       key.kind == KeyKind::color || key.kind == KeyKind::vector ? " each" : "");
  }
  std::string words;
  for (const char* const word : key.words) {
    words += fmt::format("{}`\"{}\"`", words.empty() ? "" : ", ", word);
  }
  return words;
}

std::string changes_on_page(const ShowKey& key) {
  return !key.page.varies.empty() ? std::string(key.page.varies) : key.changes ? "yes" : "no";
}

//! A table of keys in a reference page, below a heading. `tables` are the paths of the tables of a
//! show file whose keys it lists; the path "" stands for keys outside of tables.
struct DocumentedTable {
  const char* page;
  const char* heading;
  std::vector<std::string> tables;
  std::vector<std::string_view> only{};  //!< names of the keys that the table lists; empty: all
  //! The form of object (mesh file, triangle, sphere or disk) whose keys it lists; absent: any
  //! form.
  std::optional<ObjectForm> form{};
};

std::ostream& operator<<(std::ostream& out, const DocumentedTable& documented) { return out << documented.heading; }

const std::vector<DocumentedTable> documented_tables = {
    {"show-keys.md", "## Top level", {""}},
    {"show-keys.md", "## `[hole]`", {"hole"}},
    {"show-keys.md", "## `[camera]`", {"camera"}},
    {"show-keys.md", "### `[[camera.key]]`", {"camera.key"}},
    {"show-keys.md", "## `[camera.fall]`", {"camera.fall"}},
    {"show-keys.md", "## `[sky]`", {"sky"}},
    {"show-keys.md", "## `[stars]`", {"stars"}},
    {"show-keys.md", "## `[effects]`", {"effects"}},
    {"show-keys.md", "## `[view]`", {"view"}},
    {"show-keys.md", "## `[stereo]`", {"stereo"}},
    {"stereo.md", "## Keys", {"stereo"}},
    {"show-keys.md", "## `[tone]`", {"tone"}},
    {"show-keys.md", "## `[flight]`", {"flight"}},
    {"show-keys.md", "## `[headset]`", {"headset"}},
    {"show-keys.md", "## `[grid]` and `[quality]`", {"grid", "quality"}},
    {"show-keys.md", "## `[readout]`", {"readout"}},
    {"show-keys.md", "## `[[animate]]`", {"animate"}},
    {"show-keys.md", "## `[[chapter]]`", {"chapter"}},
    {"show-keys.md", "## `[[caption]]`", {"caption"}},
    {"show-keys.md", "## `[[overlay]]`", {"overlay"}},
    {"show-keys.md", "## `[[audio]]`", {"audio"}},
    {"disk.md", "## Keys", {"disk"}},
    {"shells.md", "## Keys", {"shells"}},
    {"objects.md", "## Shape", {"objects"}, {"mesh", "shape"}},
    {"objects.md", "Keys of `shape = \"triangle\"`:", {"objects"}, {"corners"}, ObjectForm::triangle},
    {"objects.md",
     "Keys of `shape = \"sphere\"`. The sphere has the radius 1 and its poles on the z axis.",
     {"objects"},
     {"segments", "rings"},
     ObjectForm::sphere},
    {"objects.md",
     "Keys of `shape = \"disk\"`. The disk is a thick ring around the z axis: red above, blue below, green at the "
     "edges.",
     {"objects"},
     {"inner", "outer", "thickness", "segments", "rings"},
     ObjectForm::disk},
    {"objects.md", "## Position", {"objects"}, {"size", "turn_deg", "position", "orbit", "key"}},
    {"objects.md", "Keys of `orbit`:", {"objects.orbit"}},
    {"objects.md", "Keys of each entry of `key`:", {"objects.key"}},
    {"objects.md",
     "## Appearance",
     {"objects"},
     {"color", "exposure", "checker", "light", "method", "retarded", "images", "tessellation"}},
    {"objects.md", "Keys of `checker`:", {"objects.checker"}},
    {"objects.md",
     "Keys of `tessellation`. [Polygons](../explanation/scene-objects.md#polygons) explains the formula.",
     {"objects.tessellation"}},
    {"objects.md", "## The lamp", {"light"}},
};

//! Returns whether the keys below a path, such as "camera.key.", have a table of their own in the
//! pages.
bool has_own_section(std::string_view path) {
  path.remove_suffix(path.ends_with('.') ? 1 : 0);
  return std::ranges::any_of(documented_tables, [&](const DocumentedTable& documented) {
    return std::ranges::count(documented.tables, path) > 0;
  });
}

//! Adds a row for each key in the table at `path`, and in tables below it that have no section of
//! their own. `settings` are default-constructed settings, from which the default values are read.
void add_rows(std::span<const ShowKey> keys, const std::string& path, const std::string& prefix, void* settings,
              const std::vector<std::string_view>& only, std::string& rows) {
  for (const ShowKey& key : keys) {
    const std::string name(key.name);
    void* const value = key.at != nullptr ? key.at(settings, 0) : nullptr;
    if (!key.meaning.empty() && (only.empty() || std::ranges::count(only, name) > 0)) {
      for (const std::string& cell :
           {fmt::format("`{}{}`", prefix, name), type_on_page(key), default_on_page(key, value), range_on_page(key),
            std::string(key.page.unit), changes_on_page(key), std::string(key.meaning)}) {
        rows += cell.empty() ? "| " : fmt::format("| {} ", cell);
      }
      rows += "|\n";
    }
    if (key.kind == KeyKind::part) {
      const bool another_form = key.applies != nullptr && !key.applies(settings);
      if (another_form) {
        continue;
      }
      add_rows(key.keys, path, prefix, value, only, rows);
    } else if (!key.keys.empty() && !has_own_section(path + name)) {
      add_rows(key.keys, path + name + ".", prefix + name + ".", value != nullptr ? value : key.make(settings), only,
               rows);
    }
  }
}

//! Finds a key by its name, also in parts of the settings. Sets `settings` to the part that
//! contains the key.
const ShowKey* find_key(std::span<const ShowKey> keys, std::string_view name, void*& settings) {
  for (const ShowKey& key : keys) {
    void* part = key.kind == KeyKind::part ? key.at(settings, 0) : settings;
    const ShowKey* const found = key.kind == KeyKind::part ? find_key(key.keys, name, part) : &key;
    if (found != nullptr && found->name == name) {
      settings = part;
      return found;
    }
  }
  return nullptr;
}

std::string rows_of(const DocumentedTable& documented) {
  std::string rows =
      "| key | type | default | range | unit | changes with time | meaning |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& path : documented.tables) {
    Show show;
    std::span<const ShowKey> keys = show_keys();
    void* settings = &show;
    std::istringstream names(path);
    for (std::string name; std::getline(names, name, '.');) {
      const ShowKey& key = *find_key(keys, name, settings);
      settings = key.make != nullptr ? key.make(settings) : key.at(settings, 0);
      keys = key.keys;
    }
    if (documented.form) {
      static_cast<ObjectSettings*>(settings)->form = *documented.form;
    }
    const std::string below = path.empty() ? "" : path + ".";
    add_rows(keys, below, documented.tables.size() > 1 ? below : "", settings, documented.only, rows);
  }
  return rows;
}

class ShowKeysPages : public testing::TestWithParam<DocumentedTable> {};

TEST_P(ShowKeysPages, ListTheKeysOfTheSchema) {
  const std::string path = std::string(ERGODOME_SOURCE_DIR "/content/docs/reference/") + GetParam().page;
  std::string page = read_whole_file(path, 1U << 20U, "");
  const std::size_t heading = page.find(fmt::format("\n{}\n", GetParam().heading));
  ASSERT_NE(heading, std::string::npos);
  const std::size_t begin = page.find("\n| key |", heading) + 1;
  const std::size_t size = page.find("\n\n", begin) + 1 - begin;
  const std::string rows = rows_of(GetParam());
  if (std::getenv("ERGODOME_RENEW_REFERENCES") != nullptr) {
    std::ofstream(path) << page.replace(begin, size, rows);
  } else {
    EXPECT_EQ(page.substr(begin, size), rows);
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, ShowKeysPages, testing::ValuesIn(documented_tables));

}  // namespace
}  // namespace ergodome
