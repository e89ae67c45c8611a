#pragma once

#include <string>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Reads [[animate]], the numbers that change with time. All other numbers of the show must have
//! been read.
void read_animations(TomlTable& root, const std::string& file, Show& show);

}  // namespace ergodome
