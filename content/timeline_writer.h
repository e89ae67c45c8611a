#pragma once

#include <toml++/toml.h>

#include "content/timeline.h"

namespace ergodome {

//! Adds to a show's table what read_timeline reads back to the same timeline; nothing where that is empty.
void add_timeline(const Timeline& timeline, toml::table& root);

}  // namespace ergodome
