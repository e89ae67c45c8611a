#pragma once

#include <string_view>

#include "content/files/toml_table.h"
#include "content/show/animatable_number.h"

namespace ergodome {

//! Reads the fixed value of an animatable number from the number's key, within its limits.
inline double own_number(TomlTable& table, std::string_view key, double otherwise) {
  const NumberLimits limits = limits_of(table.path_of(key));
  return table.number(key, otherwise, limits.least, limits.greatest);
}

}  // namespace ergodome
