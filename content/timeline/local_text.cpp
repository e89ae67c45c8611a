#include "content/timeline/local_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace ergodome {

namespace {

constexpr std::size_t max_languages = 64;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

//! Reads a nonempty text for display. TOML guarantees that it is UTF-8.
std::string read_words(TomlTable& table, std::string_view key) {
  std::string words = table.lines(key, "");
  if (words.empty()) {
    throw table.error_at(key, "is empty", "write a text");
  }
  return words;
}

}  // namespace

bool is_language_tag(std::string_view tag) {
  std::size_t part = 0;
  bool first = true;
  for (const char c : tag) {
    const bool digit = c >= '0' && c <= '9';
    if (c == '-' && part > 0) {
      first = false;
      part = 0;
    } else if ((is_letter(c) || (digit && !first)) && part < 8) {
      ++part;
    } else {
      return false;
    }
  }
  const std::size_t language = tag.find('-');
  return part > 0 && std::min(language, tag.size()) >= 2 && tag.size() <= 35;
}

LocalText read_local_text(TomlTable& table, std::string_view key) {
  const toml::node* const node = table.node(key);
  if (node == nullptr) {
    throw table.error_at(key, "is missing", "write \"TEXT\", or { en = \"TEXT\", de = \"TEXT\" }");
  }
  if (!node->is_table()) {
    return {{"", read_words(table, key)}};
  }
  const toml::table& languages = *node->as_table();
  if (languages.empty() || languages.size() > max_languages) {
    throw table.error_at(key, languages.empty() ? "has no language" : "has too many languages",
                         fmt::format("give it 1 to {} languages", max_languages));
  }
  TomlTable reader = table.below(languages, key);
  LocalText text;
  for (const auto& [tag, words] : languages) {
    // An empty tag marks the text for languages that have none of their own.
    if (!tag.str().empty() && !is_language_tag(tag.str())) {
      throw reader.error_at(tag.str(), "is not a language tag", "write a tag such as en, de or pt-BR");
    }
    text[std::string(tag.str())] = read_words(reader, tag.str());
  }
  return text;
}

void add_local_text(const LocalText& text, std::string_view key, toml::table& table) {
  if (text.size() == 1 && text.begin()->first.empty()) {
    table.insert(key, text.begin()->second);
    return;
  }
  toml::table languages;
  for (const auto& [tag, words] : text) {
    languages.insert(tag, words);
  }
  table.insert(key, std::move(languages));
}

}  // namespace ergodome
