#pragma once

#include <toml++/toml.h>

#include "content/timeline/timeline.h"

namespace ergodome {

//! Adds a text: a string, or where it has languages a table of strings.
void add_local_text(const LocalText& text, const char* key, toml::table& table);

//! Adds to a show's table what read_timeline reads back to the same timeline; nothing where that is empty.
void add_timeline(const Timeline& timeline, toml::table& root);

}  // namespace ergodome
