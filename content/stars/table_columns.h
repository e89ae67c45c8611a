#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! The quantity in a column of a star table.
enum Quantity {
  right_ascension,
  declination,
  v_magnitude,
  g_magnitude,
  vt_magnitude,
  b_v_colour,
  bp_rp_colour,
  bp_magnitude,
  rp_magnitude,
  bt_magnitude,
  star_temperature_k,
  catalogue_number,
  sun_distance,
  quantity_count
};

//! Returns the quantity in words for messages: "a declination".
const char* words_of(Quantity quantity);

//! The unit of a coordinate. `open`: not stated; decided by the values of the column.
enum class AngleUnit { open, degrees, hours, radians };

//! The source of the unit of a coordinate. `values`: its values; `name`: the column's name;
//! `units_row`: a row of units, an ECSV comment, or brackets after the name; `program`: the program
//! that wrote the table.
enum class UnitSource { values, name, units_row, program };

struct CoordinateUnit {
  AngleUnit unit = AngleUnit::open;
  UnitSource source = UnitSource::values;
};

//! The columns of a table that are read.
struct TableColumns {
  //! Quantity of each column; empty if the column is not read.
  std::vector<std::optional<Quantity>> quantities;
  //! Column name for each quantity, as written in the table; empty if absent.
  std::vector<std::string> names;
  CoordinateUnit ra;
  CoordinateUnit dec = {AngleUnit::degrees, UnitSource::name};
  std::string program;  //!< the program or archive that wrote the table: "Gaia's archive", "HYG"; empty if unknown

  [[nodiscard]] bool has(Quantity quantity) const { return !names[quantity].empty(); }
};

//! Units by lower-case column name, from comments that describe the columns (ECSV).
using UnitsByName = std::map<std::string, std::string, std::less<>>;

//! Chooses the columns to read. If several hold the same quantity, the order of preference decides.
//! Both coordinates come from one pair (KnownName::pair) if possible. Throws Error at `location` if
//! a coordinate or a magnitude is missing, a name occurs twice, or a unit is not supported.
TableColumns choose_columns(const std::vector<std::string>& names, const UnitsByName& units,
                            const std::string& location);

//! Applies the unit of a coordinate's column, or checks the unit of another column. Throws Error if
//! the unit is not supported.
void apply_unit(TableColumns& columns, Quantity quantity, std::string_view unit, UnitSource source,
                const std::string& location);

}  // namespace ergodome
