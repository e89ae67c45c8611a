#pragma once

#include <string_view>

#include "content/files/toml_table.h"
#include "content/timeline/timeline.h"

// Texts in several languages in a show file.
namespace ergodome {

//! Returns true if a tag has the form of BCP 47: "en", "pt-BR", "zh-Hant".
bool is_language_tag(std::string_view tag);

//! Reads a text that is either a string or a table of strings by language tags. Throws Error if it
//! is missing or empty, or if a tag is invalid.
LocalText read_local_text(TomlTable& table, std::string_view key);

//! Adds a text: a string, or a table of strings if it has languages.
void add_local_text(const LocalText& text, std::string_view key, toml::table& table);

}  // namespace ergodome
