#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

class TomlTable;

//! Reads the tables [[shells]] of a show file. Throws Error with file, line and key for invalid
//! values.
std::vector<ShellSettings> read_shells(TomlTable& root, const std::string& file);

//! Throws Error if a shell is inside the horizon, or too close to it, at any time.
void check_shells(TomlTable& root, const std::string& file, const Show& show);

//! Returns shells as tables that read_shells() accepts.
toml::array shell_tables(const std::vector<ShellSettings>& shells);

}  // namespace ergodome
