#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! What a column of a star table holds.
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

//! Returns what messages call a column: "a declination".
const char* words_of(Quantity quantity);

//! Unit of a coordinate. `open`: nothing but the values tells.
enum class AngleUnit { open, degrees, hours, radians };

//! Where the unit of the right ascension comes from.
//! `units_row`: a row of units, a comment of ECSV, or brackets behind the name.
enum class UnitSource { values, name, units_row, program };

struct CoordinateUnit {
  AngleUnit unit = AngleUnit::open;
  UnitSource source = UnitSource::values;
};

//! The columns of a table that are read.
struct TableColumns {
  std::vector<std::optional<Quantity>> quantities;  //!< by the column's index
  std::vector<std::string> names;  //!< by quantity, as the table writes them; empty where there is none
  CoordinateUnit ra;
  CoordinateUnit dec = {AngleUnit::degrees, UnitSource::name};
  std::string program;  //!< whose columns these are: "Gaia's archive", "HYG"; empty if unknown

  [[nodiscard]] bool has(Quantity quantity) const { return !names[quantity].empty(); }
};

//! Units by a column's name in lower case, from comments that describe the columns (ECSV).
using UnitsByName = std::map<std::string, std::string, std::less<>>;

//! Chooses the columns to read. Where several hold the same quantity, the order of preference
//! decides, and coordinates come from one pair. Throws Error at `place` if a quantity is missing,
//! if a name comes twice, and if a unit is not supported.
TableColumns choose_columns(const std::vector<std::string>& names, const UnitsByName& units, const std::string& place);

//! Applies the unit of one column. Throws Error if it is not supported.
void apply_unit(TableColumns& columns, Quantity quantity, std::string_view unit, UnitSource source,
                const std::string& place);

}  // namespace ergodome
