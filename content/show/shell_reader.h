#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

class TomlTable;

//! Reads the tables [[shells]] of a show's file. Throws Error with file, line and key for what cannot be.
std::vector<ShellSettings> read_shells(TomlTable& root, const std::string& file);

//! Throws Error where a shell is inside the horizon at some time, or too near to it.
void check_shells(TomlTable& root, const std::string& file, const Show& show);

//! Shells as tables that read_shells reads back.
toml::array shell_tables(const std::vector<ShellSettings>& shells);

}  // namespace ergodome
