#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/sky/map_layout.h"

namespace ergodome {

//! Reads `sky.map_layout`. Throws Error for unknown words and keys.
MapLayout read_map_layout(const toml::table& table, const std::string& file);

//! Returns a layout as a table that read_map_layout() accepts.
toml::table map_layout_table(const MapLayout& layout);

}  // namespace ergodome
