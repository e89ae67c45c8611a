#include "content/stars/table_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "content/files/printable.h"
#include "content/stars/column_names.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr const char* quantity_words[quantity_count] = {
    "a right ascension", "a declination", "a magnitude", "a magnitude",   "a magnitude",      "a color",   "a color",
    "a magnitude",       "a magnitude",   "a magnitude", "a temperature", "a catalog number", "a distance"};

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

//! Returns the end of an error message about a missing quantity: a semicolon, and a note that the
//! table has related columns, which cannot be used instead. Empty if it has no such columns.
std::string substitute_for(Quantity missing, const std::vector<std::string>& names) {
  for (const Substitute& other : column_substitutes()) {
    // One-letter names are ambiguous, so all columns of the substitute must be present.
    const bool all = other.names.begin()->size() == 1;
    const auto there = [&](std::string_view name) { return holds(names, name); };
    if (other.missing == missing &&
        (all ? std::ranges::all_of(other.names, there) : std::ranges::any_of(other.names, there))) {
      return fmt::format("; it has {}, which cannot be used", other.what);
    }
  }
  return "";
}

//! Returns the index of the first column with a name, or nothing.
std::optional<std::size_t> find_column(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

//! A known name and the column that has it.
struct Candidate {
  const KnownName* known;
  std::size_t column;
};

std::vector<Candidate> candidates_for(Quantity quantity, const std::vector<std::string>& names) {
  std::vector<Candidate> found;
  for (const KnownName& known : known_column_names()) {
    const auto column = known.quantity == quantity ? find_column(names, known.name) : std::nullopt;
    if (column) {
      found.push_back({&known, *column});
    }
  }
  return found;
}

//! Chooses two coordinates of one pair, or the preferred one of each if no pair exists.
std::array<std::optional<Candidate>, 2> choose_coordinates(const std::vector<std::string>& names) {
  const auto ras = candidates_for(right_ascension, names);
  const auto decs = candidates_for(declination, names);
  for (const Candidate& ra : ras) {
    for (const Candidate& dec : decs) {
      if (ra.known->pair == dec.known->pair) {
        return {ra, dec};
      }
    }
  }
  return {ras.empty() ? std::nullopt : std::optional(ras.front()),
          decs.empty() ? std::nullopt : std::optional(decs.front())};
}

//! Sets the program that wrote the table, if its column names identify one. That program decides
//! the unit of the right ascension if it is still open.
void find_program(TableColumns& columns, const std::vector<std::string>& names) {
  const auto any = [&](std::initializer_list<std::string_view> signs) {
    return std::ranges::any_of(signs, [&](std::string_view sign) { return holds(names, sign); });
  };
  if (any({"source_id", "phot_g_mean_mag", "bp_rp", "teff_gspphot"})) {
    columns.program = "Gaia's archive";
  } else if (any({"main_id"})) {
    columns.program = "SIMBAD";
  } else if (any({"proper", "rarad", "ci"})) {
    columns.program = "HYG";
  }
  if (columns.ra.unit == AngleUnit::open && !columns.program.empty()) {
    columns.ra = {columns.program == "HYG" ? AngleUnit::hours : AngleUnit::degrees, UnitSource::program};
  }
}

void require_coordinates_and_magnitude(const TableColumns& columns, const std::vector<std::string>& names,
                                       const std::string& location) {
  std::string missing;
  std::string instead;
  std::string names_to_use;
  const auto require = [&](bool there, Quantity quantity) {
    if (!there) {
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", quantity_words[quantity]);
      names_to_use += fmt::format("{}{}", names_to_use.empty() ? "" : ", ", column_name_to_use(quantity));
      instead += substitute_for(quantity, names);
    }
  };
  require(columns.has(right_ascension), right_ascension);
  require(columns.has(declination), declination);
  require(columns.has(v_magnitude) || columns.has(g_magnitude) || columns.has(vt_magnitude), v_magnitude);
  if (!missing.empty()) {
    throw Error(location, fmt::format("has no column for {}{}", missing, instead),
                fmt::format("name the columns in the first line, for example {}; other names: see "
                            "reference/star-tables.md in the documentation",
                            names_to_use));
  }
}

//! Returns true if a unit is supported for a quantity that is not a coordinate.
bool is_supported_unit(Quantity quantity, std::string_view unit) {
  const auto one_of = [&](std::initializer_list<std::string_view> units) {
    return std::ranges::find(units, unit) != units.end();
  };
  if (unit.empty() || quantity == catalogue_number || quantity == sun_distance) {
    return true;
  }
  return quantity == star_temperature_k ? one_of({"K", "k", "Kelvin", "kelvin", "---"})
                                        : one_of({"mag", "Mag", "mags", "---", "-", "V", "Johnson", "Vega"});
}

}  // namespace

const char* words_of(Quantity quantity) { return quantity_words[quantity]; }

void apply_unit(TableColumns& columns, Quantity quantity, std::string_view unit, UnitSource source,
                const std::string& location) {
  if (quantity == right_ascension || quantity == declination) {
    if (const auto known = angle_unit_named(unit)) {
      (quantity == right_ascension ? columns.ra : columns.dec) = {*known, source};
    } else if (!unit.empty() && unit != "J2000" && unit != "J2000.0" && unit != "2000" && unit != "ICRS") {
      throw Error(location,
                  fmt::format("gives {} in the unsupported unit or equinox \"{}\"", words_of(quantity),
                              printable(unit.substr(0, 40))),
                  "convert the column to degrees (deg), hours (h) or radians (rad), equinox J2000");
    }
  } else if (!is_supported_unit(quantity, unit)) {
    throw Error(
        location,
        fmt::format("gives {} in the unsupported unit \"{}\"", words_of(quantity), printable(unit.substr(0, 40))),
        quantity == star_temperature_k ? "convert the column to kelvins (K)"
                                       : "convert the column to magnitudes (mag)");
  }
}

TableColumns choose_columns(const std::vector<std::string>& names, const UnitsByName& units,
                            const std::string& location) {
  std::vector<std::string> plain;
  plain.reserve(names.size());
  for (const std::string& name : names) {
    plain.push_back(plain_column_name(name));
    // In VizieR, gmag is from the Sloan survey and Gmag from Gaia.
    if (plain.back() == "gmag" && name.find('G') == std::string::npos) {
      plain.back() = "sloan_gmag";
    }
  }
  TableColumns columns;
  columns.quantities.resize(names.size());
  columns.names.resize(quantity_count);
  const auto read = [&](const Candidate& chosen) {
    const Quantity quantity = chosen.known->quantity;
    const std::string& name = plain[chosen.column];
    if (std::ranges::count(plain, name) > 1) {
      throw Error(location, fmt::format("has two columns for {} named {}", words_of(quantity), name),
                  "remove or rename one of them");
    }
    columns.quantities[chosen.column] = quantity;
    columns.names[quantity] = names[chosen.column];
    if (quantity == right_ascension && chosen.known->unit != AngleUnit::open) {
      columns.ra = {chosen.known->unit, UnitSource::name};
    }
    apply_unit(columns, quantity, bracketed_unit(names[chosen.column]), UnitSource::units_row, location);
    if (const auto unit = units.find(name); unit != units.end()) {
      apply_unit(columns, quantity, unit->second, UnitSource::units_row, location);
    }
  };
  for (const auto& coordinate : choose_coordinates(plain)) {
    if (coordinate) {
      read(*coordinate);
    }
  }
  for (int quantity = declination + 1; quantity < quantity_count; ++quantity) {
    auto found = candidates_for(static_cast<Quantity>(quantity), plain);
    if (!found.empty()) {
      // Of several columns with catalog numbers, the leftmost is read: HYG's id, which precedes
      // hip.
      read(quantity == catalogue_number ? *std::ranges::min_element(found, {}, &Candidate::column) : found.front());
    }
  }
  find_program(columns, plain);
  require_coordinates_and_magnitude(columns, plain, location);
  return columns;
}

}  // namespace ergodome
