#pragma once

#include <toml++/toml.h>

#include "content/timeline/timeline.h"

namespace ergodome {

//! Adds a text: a string, or a table of strings if it has languages.
void add_local_text(const LocalText& text, const char* key, toml::table& table);

//! Adds a timeline to a show's table, from which read_timeline() reads it back; adds nothing for an
//! empty one.
void add_timeline(const Timeline& timeline, toml::table& root);

}  // namespace ergodome
