#include "content/show/reading/show_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "content/files/printable.h"
#include "content/files/toml_bounds.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t longest_setting = std::size_t{1} << 20U;
constexpr std::size_t max_path_parts = 16;

//! One setting from the command line, split into the parts of its path and its value.
struct Setting {
  std::string location;            //!< name of the setting in messages: "--set hole.spin"
  std::vector<std::string> parts;  //!< the parts of the path: "hole", "spin"
  std::string value;
};

bool is_bare_key(std::string_view part) {
  return !part.empty() && std::ranges::all_of(part, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

//! Splits a path at its dots. "key[0]", as messages write it, is equivalent to "key.0".
std::vector<std::string> parts_of_path(std::string_view path) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '.' || path[i] == '[') {
      parts.emplace_back();
    } else if (path[i] != ']' || (i + 1 < path.size() && path[i + 1] != '.')) {
      parts.back() += path[i];
    }
  }
  return parts;
}

Setting split_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string shown = printable(std::string_view(text).substr(0, std::min<std::size_t>(equals, 200)));
  Setting setting{fmt::format("{} {}", show_setting_option, shown), {}, {}};
  constexpr const char* remedy = "write KEY=VALUE, for example hole.spin=0.5 or camera.key.0.r=30";
  if (equals == std::string::npos) {
    throw Error(setting.location, "has no value", remedy);
  }
  if (text.size() > longest_setting) {
    throw Error(setting.location, "is longer than 1 MiB", "write such a value into the show file");
  }
  setting.parts = parts_of_path(std::string_view(text).substr(0, equals));
  if (setting.parts.size() > max_path_parts || !std::ranges::all_of(setting.parts, is_bare_key)) {
    throw Error(setting.location, "is not the path of a key", remedy);
  }
  setting.value = text.substr(equals + 1);
  return setting;
}

//! Returns an empty table with the setting as its source.
toml::table empty_table_of(const Setting& setting) {
  toml::table parsed = toml::parse("t = {}", setting.location);
  return std::move(*parsed["t"].as_table());
}

//! Parses `value = TEXT`; returns nothing unless TEXT is one valid TOML value in one line.
std::optional<toml::table> parsed_value(const Setting& setting, const std::string& text) {
  const std::string line = "value = " + text;
  require_bounded_toml(line, setting.location);
  try {
    toml::table parsed = toml::parse(line, setting.location);
    return parsed.size() == 1 && text.find('\n') == std::string::npos ? std::optional(std::move(parsed)) : std::nullopt;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

//! Returns text as a quoted TOML string with escapes. Bytes that are not UTF-8 stay: the TOML
//! parser rejects them.
std::string toml_string_of(std::string_view text) {
  std::string string = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      string += '\\';
      string += c;
    } else if (code < 0x20 || code == 0x7f) {
      string += fmt::format("\\u{:04x}", code);
    } else {
      string += c;
    }
  }
  return string + '"';
}

//! Returns a table that holds the setting's value under "value".
toml::table table_of_value(const Setting& setting) {
  if (auto parsed = parsed_value(setting, setting.value)) {
    return std::move(*parsed);
  }
  const std::size_t first = setting.value.find_first_not_of(" \t");
  if (first != std::string::npos && std::string_view("\"'[{").find(setting.value[first]) != std::string_view::npos) {
    throw Error(setting.location,
                fmt::format("has a malformed value: {}", printable(std::string_view(setting.value).substr(0, 100))),
                "close its quotes and brackets, and quote it for the shell: --set 'title=\"A title\"'");
  }
  if (auto parsed = parsed_value(setting, toml_string_of(setting.value))) {
    return std::move(*parsed);
  }
  throw Error(setting.location, "has a value that is not valid UTF-8", "write it in UTF-8");
}

//! Returns the first `count` parts of the path, in the form that messages use.
std::string path_up_to(const Setting& setting, std::size_t count) {
  return fmt::format("{}", fmt::join(setting.parts.begin(), setting.parts.begin() + static_cast<long>(count), "."));
}

//! Returns the array entry that a part of the path selects. Throws Error if it does not exist.
toml::node& entry_of(toml::array& entries, const Setting& setting, std::size_t depth, const std::string& file) {
  const std::string& part = setting.parts[depth];
  std::size_t index = 0;
  const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (problem != std::errc() || end != part.data() + part.size() || index >= entries.size()) {
    throw Error(setting.location,
                fmt::format("{} has no entry {} ({} has {})", path_up_to(setting, depth), part, file,
                            counted(static_cast<long>(entries.size()), "such entry", "such entries")),
                "count from 0; to add entries, set the whole list");
  }
  return entries[index];
}

//! Replaces an array entry of any type by a value.
void replace_entry(toml::array& entries, toml::node& entry, toml::node& value) {
  const auto at = std::ranges::find_if(entries, [&](const toml::node& each) { return &each == &entry; });
  value.visit([&](auto& concrete) { entries.replace(at, std::move(concrete)); });
}

void apply_setting(toml::table& show, const Setting& setting, const std::string& file) {
  toml::table parsed = table_of_value(setting);
  toml::node& value = *parsed.get("value");
  toml::node* at = &show;
  for (std::size_t depth = 0; depth < setting.parts.size(); ++depth) {
    const std::string& part = setting.parts[depth];
    const bool last = depth + 1 == setting.parts.size();
    if (toml::table* const table = at->as_table()) {
      if (last) {
        value.visit([&](auto& concrete) { table->insert_or_assign(part, std::move(concrete)); });
        return;
      }
      if (!table->contains(part)) {
        table->insert(part, empty_table_of(setting));
      }
      at = table->get(part);
    } else if (toml::array* const entries = at->as_array()) {
      toml::node& entry = entry_of(*entries, setting, depth, file);
      if (last) {
        replace_entry(*entries, entry, value);
        return;
      }
      at = &entry;
    } else {
      const std::string path = path_up_to(setting, depth);
      throw Error(setting.location, fmt::format("{} is a single value in {}, not a table or list", path, file),
                  fmt::format("set {} itself", path));
    }
  }
}

//! Returns the path of a setting as [[animate]] writes it: "shells[0].radius".
std::string path_of_number(const Setting& setting) {
  std::string path;
  for (const std::string& part : setting.parts) {
    if (part.find_first_not_of("0123456789") == std::string::npos) {
      path += fmt::format("[{}]", part);
    } else {
      path += (path.empty() ? "" : ".") + part;
    }
  }
  return path;
}

//! Returns the path of the number that an entry of [[animate]] changes; empty if it is malformed.
std::string animated_number(const toml::node& entry) {
  const toml::table* const animation = entry.as_table();
  return animation != nullptr ? (*animation)["number"].value_or(std::string()) : std::string();
}

//! Removes the [[animate]] entries of a number, or of the numbers in a table or list, because they
//! would override the setting. Keeps several entries of the same number, so that the reader reports
//! them.
void remove_animations(toml::table& show, const std::string& path) {
  toml::array* const animations = show["animate"].as_array();
  if (animations == nullptr) {
    return;
  }
  for (std::size_t i = animations->size(); i > 0; --i) {
    const std::string number = animated_number((*animations)[i - 1]);
    const bool set = number == path || number.starts_with(path + ".") || number.starts_with(path + "[");
    if (set && std::ranges::count(*animations, number, animated_number) == 1) {
      animations->erase(animations->begin() + static_cast<std::ptrdiff_t>(i - 1));
    }
  }
}

}  // namespace

void apply_settings(toml::table& show, const ShowSettings& settings, const std::string& file) {
  std::vector<Setting> applied;
  for (const std::string& text : settings) {
    applied.push_back(split_setting(text));
    apply_setting(show, applied.back(), file);
  }
  // Runs after all settings, because they count the entries of [[animate]] as in the file.
  for (const Setting& setting : applied) {
    remove_animations(show, path_of_number(setting));
  }
}

}  // namespace ergodome
