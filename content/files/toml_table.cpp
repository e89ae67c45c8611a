#include "content/files/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "content/files/printable.h"
#include "content/files/toml_bounds.h"

namespace ergodome {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

//! Returns a key or word for messages, with limited length.
std::string shown(std::string_view key) { return printable(key.substr(0, 60)); }

//! Returns a key's path in the form of command-line settings: "camera.key.0.r" for
//! "camera.key[0].r".
std::string setting_path(std::string path) {
  std::erase(path, ']');
  std::ranges::replace(path, '[', '.');
  return path;
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  const std::string_view bounded = word.substr(0, 100);
  std::string nearest;
  // Only distances below this count: a less similar word would be a guess, not a correction.
  std::size_t minimum = bounded.size() / 3 + 2;
  for (const std::string& candidate : words) {
    const std::size_t distance = edit_distance(bounded, candidate);
    if (distance < minimum) {
      minimum = distance;
      nearest = candidate;
    }
  }
  // An abbreviation has a large edit distance to its word, so words of at least this length are
  // also compared with the beginnings of the words.
  constexpr std::size_t min_letters = 3;
  const auto begins = [&](const std::string& candidate) { return candidate.starts_with(bounded); };
  if (nearest.empty() && bounded.size() >= min_letters && std::ranges::count_if(words, begins) == 1) {
    nearest = *std::ranges::find_if(words, begins);
  }
  return nearest;
}

std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? shown(key) : path_ + "." + shown(key);
}

Error TomlTable::error_at(std::string_view key, const std::string& problem, const std::string& remedy) const {
  const toml::node* at = table_.get(key);
  const toml::source_region& source = at != nullptr ? at->source() : table_.source();
  const std::string location = source.begin.line > 0 ? fmt::format("{}:{}", file_, source.begin.line) : file_;
  return {is_from(source, file_) ? location : *source.path, fmt::format("{} {}", path_of(key), problem), remedy};
}

bool is_from(const toml::source_region& source, const std::string& file) {
  return source.path == nullptr || *source.path == file;
}

const toml::node* TomlTable::node(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

double TomlTable::number(std::string_view key, double otherwise, double minimum, double maximum) {
  const toml::node* at = node(key);
  if (at == nullptr) {
    return otherwise;
  }
  const auto value = at->value<double>();
  if (!at->is_number() || !value) {
    throw error_at(key, "is not a number", "write a number such as 1.5");
  }
  if (!(*value >= minimum && *value <= maximum)) {
    throw error_at(key, fmt::format("is {}, outside {} to {}", *value, minimum, maximum),
                   "choose a value in that range");
  }
  return *value;
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t min_count, std::size_t max_count,
                                       double minimum, double maximum) {
  std::vector<double> found;
  const toml::node* at = node(key);
  if (at == nullptr) {
    return found;
  }
  const toml::array* list = at->as_array();
  if (list == nullptr || list->size() < min_count || list->size() > max_count) {
    throw error_at(key,
                   min_count == max_count ? fmt::format("is not a list of {} numbers", max_count)
                                          : fmt::format("is not a list of {} to {} numbers", min_count, max_count),
                   min_count == max_count ? fmt::format("write {} numbers in brackets", max_count)
                                          : fmt::format("write {} to {} numbers in brackets", min_count, max_count));
  }
  for (const toml::node& item : *list) {
    const auto value = item.value<double>();
    if (!item.is_number() || !value || !(*value >= minimum && *value <= maximum)) {
      throw error_at(key, fmt::format("contains an entry that is not a number from {} to {}", minimum, maximum),
                     "correct that entry");
    }
    found.push_back(*value);
  }
  return found;
}

int TomlTable::integer(std::string_view key, int otherwise, int minimum, int maximum) {
  const toml::node* at = node(key);
  if (at == nullptr) {
    return otherwise;
  }
  const auto value = at->value_exact<int64_t>();
  if (!value || *value < minimum || *value > maximum) {
    throw error_at(key, fmt::format("is not a whole number from {} to {}", minimum, maximum),
                   "choose one in that range");
  }
  return static_cast<int>(*value);
}

bool TomlTable::boolean(std::string_view key, bool otherwise) {
  const toml::node* at = node(key);
  if (at == nullptr) {
    return otherwise;
  }
  const auto value = at->value_exact<bool>();
  if (!value) {
    throw error_at(key, "is neither true nor false", "write true or false, without quotes");
  }
  return *value;
}

std::string TomlTable::text(std::string_view key, const std::string& otherwise) {
  std::string line = lines(key, otherwise);
  if (line.find('\n') != std::string::npos) {
    throw error_at(key, "contains a line break", "write it on one line");
  }
  return line;
}

std::string TomlTable::lines(std::string_view key, const std::string& otherwise) {
  const toml::node* at = node(key);
  if (at == nullptr) {
    return otherwise;
  }
  const auto value = at->value_exact<std::string>();
  if (!value || value->size() > 4096) {
    throw error_at(key, "is not a text of at most 4096 bytes", "write it in quotes");
  }
  if (find_control(*value) != std::string::npos) {
    throw error_at(key, "contains a control character", "remove it");
  }
  return *value;
}

int TomlTable::choice(std::string_view key, int otherwise, std::span<const char* const> words) {
  if (node(key) == nullptr) {
    return otherwise;
  }
  const std::string word = text(key, "");
  const auto found = std::ranges::find(words, word);
  if (found != words.end()) {
    return static_cast<int>(found - words.begin());
  }
  const std::string nearest = nearest_word(word, {words.begin(), words.end()});
  throw error_at(key, fmt::format("is \"{}\"", shown(word)),
                 nearest.empty() ? fmt::format("choose one of {}", fmt::join(words, ", "))
                                 : fmt::format("did you mean \"{}\"? Available: {}", nearest, fmt::join(words, ", ")));
}

const toml::table* TomlTable::table(std::string_view key) {
  const toml::node* at = node(key);
  if (at == nullptr) {
    return nullptr;
  }
  if (!at->is_table()) {
    throw error_at(key, "is not a table", fmt::format("write [{}] on a line of its own", path_of(key)));
  }
  return at->as_table();
}

std::vector<const toml::table*> TomlTable::tables(std::string_view key, std::size_t max_count) {
  std::vector<const toml::table*> found;
  const toml::node* at = node(key);
  if (at == nullptr) {
    return found;
  }
  const toml::array* list = at->as_array();
  if (list == nullptr || list->size() > max_count) {
    throw error_at(key, "is not a list of tables, or is too long",
                   fmt::format("write [[{}]], at most {} times", path_of(key), max_count));
  }
  for (const toml::node& item : *list) {
    if (!item.is_table()) {
      throw error_at(key, "contains an entry that is not a table",
                     fmt::format("write each entry as [[{}]]", path_of(key)));
    }
    found.push_back(item.as_table());
  }
  return found;
}

void TomlTable::refuse_unknown_keys() const {
  for (const auto& [key, value] : table_) {
    if (!known_.contains(key.str())) {
      std::string nearest = nearest_word(key.str(), {known_.begin(), known_.end()});
      if (!nearest.empty() && !is_from(value.source(), file_)) {
        nearest = setting_path(path_of(nearest));
      }
      throw error_at(key.str(), "is not a known key",
                     nearest.empty() ? fmt::format("known keys: {}", fmt::join(known_, ", "))
                                     : fmt::format("did you mean \"{}\"?", nearest));
    }
  }
}

toml::table parse_toml(std::string_view text, const std::string& file, std::size_t largest_mib, std::string_view kind) {
  if (text.size() > (largest_mib << 20U)) {
    throw Error(file, fmt::format("is larger than {} MiB", largest_mib),
                fmt::format("check the path: {} is a small text file", kind));
  }
  if (text.substr(0, 4096).find('\0') != std::string_view::npos) {
    throw Error(file, "is not a text file", fmt::format("check the path: {} is a text file (.toml)", kind));
  }
  require_bounded_toml(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& problem) {
    constexpr std::size_t longest_description = 300;
    throw Error(fmt::format("{}:{}", file, problem.source().begin.line),
                printable(problem.description().substr(0, longest_description)), "correct the TOML on that line");
  }
}

}  // namespace ergodome
