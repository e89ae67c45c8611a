#pragma once

#include "content/show/show_key.h"

namespace ergodome {

//! Reads keys of a table into `settings`. Throws Error with file, line and key for invalid values.
void read_keys(std::span<const ShowKey> keys, TomlTable& table, void* settings);

template <class Settings>
void read_settings(KeyTable<Settings> keys, TomlTable& table, Settings& settings) {
  read_keys(keys.keys, table, &settings);
}

//! Returns the settings as a table that read_keys() reads.
toml::table written_keys(std::span<const ShowKey> keys, const void* settings);

template <class Settings>
toml::table written_settings(KeyTable<Settings> keys, const Settings& settings) {
  return written_keys(keys.keys, &settings);
}

}  // namespace ergodome
