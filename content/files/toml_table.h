#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

//! Reads one table of a TOML file and rejects unknown keys. Every error names file, line and key.
class TomlTable {
 public:
  //! `path` is the name of the table in messages ("camera.key[2]"); empty for the whole file.
  TomlTable(const toml::table& table, std::string file, std::string path)
      : table_(table), file_(std::move(file)), path_(std::move(path)) {}

  //! Reads a number within [minimum, maximum]; returns `otherwise` if the key is absent. Throws
  //! Error for other values.
  double number(std::string_view key, double otherwise, double minimum, double maximum);
  //! Reads a list of `min_count` to `max_count` numbers within [minimum, maximum]; returns an empty
  //! list if the key is absent.
  std::vector<double> numbers(std::string_view key, std::size_t min_count, std::size_t max_count, double minimum,
                              double maximum);
  int integer(std::string_view key, int otherwise, int minimum, int maximum);
  bool boolean(std::string_view key, bool otherwise);
  //! Reads a text of a single line, of at most 4096 bytes, without control characters; returns
  //! `otherwise` if the key is absent.
  std::string text(std::string_view key, const std::string& otherwise);
  //! Reads a text of at most 4096 bytes without control characters other than line breaks.
  std::string lines(std::string_view key, const std::string& otherwise);

  //! Reads one of the given words and returns its index; returns `otherwise` if the key is absent.
  //! Throws Error for other words.
  int choice(std::string_view key, int otherwise, std::span<const char* const> words);
  int choice(std::string_view key, int otherwise, std::initializer_list<const char*> words) {
    return choice(key, otherwise, std::span(words.begin(), words.size()));
  }

  //! Returns a table below this one, or nullptr.
  const toml::table* table(std::string_view key);
  //! Returns the tables of an array of tables; empty if the key is absent.
  std::vector<const toml::table*> tables(std::string_view key, std::size_t max_count);
  //! Returns the node of a key, or nullptr; marks the key as known.
  const toml::node* node(std::string_view key);

  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  [[nodiscard]] std::string path_of(std::string_view key) const;
  //! Returns a reader of a table below this one, whose messages call it `key`.
  [[nodiscard]] TomlTable below(const toml::table& table, std::string_view key) const {
    return {table, file_, path_of(key)};
  }

  //! Returns an error about a key: "FILE:LINE: KEY PROBLEM; REMEDY". If the key was set on the
  //! command line, the option and the key replace file and line.
  [[nodiscard]] Error error_at(std::string_view key, const std::string& problem, const std::string& remedy) const;

  //! Throws Error, which names the nearest known key, if the table has an unknown key. Call it
  //! after reading all keys.
  void refuse_unknown_keys() const;

 private:
  const toml::table& table_;
  std::string file_;
  std::string path_;
  std::set<std::string, std::less<>> known_;
};

//! Returns true if a node comes from this file. Otherwise it was set on the command line, and the
//! path of its source is the option with the key.
bool is_from(const toml::source_region& source, const std::string& file);

//! Parses a TOML file of at most `largest_mib` MiB and within the limits of toml_bounds.h; `kind`
//! describes the file ("a show"). Throws Error with file and line.
toml::table parse_toml(std::string_view text, const std::string& file, std::size_t largest_mib, std::string_view kind);

//! Returns the word with the smallest edit distance to `word`. If none is close and `word` has at
//! least three letters, returns the only word that begins with it. Returns an empty text otherwise.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace ergodome
