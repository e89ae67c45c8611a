#pragma once

#include "content/show/show_key.h"

namespace ergodome {

//! Reads the keys of a table into `settings`. Throws Error with file, line and key for unknown keys
//! and invalid values.
void read_keys(std::span<const ShowKey> keys, TomlTable& table, void* settings);

//! Returns the settings as a table that read_keys() reads.
toml::table written_keys(std::span<const ShowKey> keys, const void* settings);

//! Reads these keys of a table that has other keys, too.
void read_some_keys(std::span<const ShowKey> keys, TomlTable& table, void* settings);

}  // namespace ergodome
