#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

//! Reads one table of a TOML file and holds its keys to those that are known: every problem names file, line and key.
class TomlTable {
 public:
  //! `path` is how the table is called in messages ("camera.key[2]"); empty for the whole file.
  TomlTable(const toml::table& table, std::string file, std::string path)
      : table_(table), file_(std::move(file)), path_(std::move(path)) {}

  //! A number that is neither NaN nor infinite, within [least, greatest]; `otherwise` where the key is absent.
  double number(std::string_view key, double otherwise, double least, double greatest);
  //! A list of such numbers, from `fewest` to `most` of them; empty where the key is absent.
  std::vector<double> numbers(std::string_view key, std::size_t fewest, std::size_t most, double least,
                              double greatest);
  int integer(std::string_view key, int otherwise, int least, int greatest);
  bool boolean(std::string_view key, bool otherwise);
  //! One line without control characters, of at most 4096 bytes.
  std::string text(std::string_view key, const std::string& otherwise);
  //! The same, but line breaks are allowed.
  std::string lines(std::string_view key, const std::string& otherwise);

  //! One of the given words; returns its place in the list.
  int choice(std::string_view key, int otherwise, std::initializer_list<std::string_view> words);

  //! A table below this one, or nullptr.
  const toml::table* table(std::string_view key);
  //! The tables of an array of tables; empty where the key is absent.
  std::vector<const toml::table*> tables(std::string_view key, std::size_t most);
  //! The value as it is, or nullptr; marks the key as known.
  const toml::node* node(std::string_view key);

  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  [[nodiscard]] std::string path_of(std::string_view key) const;

  //! Complains about a key: "FILE:LINE: KEY PROBLEM; REMEDY". For a key that was set on the command
  //! line, the option and the key stand in place of file and line.
  [[nodiscard]] Error error_at(std::string_view key, const std::string& problem, const std::string& remedy) const;

  //! Call when all keys have been read: an unknown key is an error that names the nearest known one.
  void refuse_unknown_keys() const;

 private:
  const toml::table& table_;
  std::string file_;
  std::string path_;
  std::set<std::string, std::less<>> known_;
};

//! Returns whether a node comes from this file. A node that does not was set on the command line, and the path of its source
//! names the option and the key.
bool is_from(const toml::source_region& source, const std::string& file);

//! Parses a TOML file of at most `largest_mib` MiB and within the limits of toml_bounds.h; `kind` is what such a file is ("a
//! show"). Throws Error with file and line.
toml::table parse_toml(std::string_view text, const std::string& file, std::size_t largest_mib, std::string_view kind);

//! The word of a list that is closest to `word` by edit distance, or, where it has three letters or more, the only one that begins with them; empty when there is none.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace ergodome
