#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "content/stars/table_columns.h"

namespace ergodome {

//! A name of a column that tables use for a quantity.
struct KnownName {
  std::string_view name;
  Quantity quantity;
  //! Names with the same number form a pair of coordinates; pairs with smaller numbers are
  //! preferred.
  int pair = 0;
  AngleUnit unit = AngleUnit::open;
};

//! Returns all names in order of preference.
std::span<const KnownName> known_column_names();

//! Returns the preferred name of a column, for messages.
std::string_view column_name_to_use(Quantity quantity);

//! Columns whose presence explains in messages why a quantity is missing from a table.
struct Substitute {
  Quantity missing;
  std::initializer_list<std::string_view> names;
  const char* what;
};

std::span<const Substitute> column_substitutes();

//! Returns the text in brackets at the end of a name: "deg" of "RA (deg)" or "ra[deg]".
std::string_view bracketed_unit(std::string_view name);

//! Returns a column's name for comparisons: lower case, without a unit in brackets, with _ for
//! spaces, dots and hyphens.
std::string plain_column_name(std::string_view name);

//! Returns the unit of a coordinate from its word in a units row: "deg", "h", "h:m:s", "rad".
std::optional<AngleUnit> angle_unit_named(std::string_view word);

}  // namespace ergodome
