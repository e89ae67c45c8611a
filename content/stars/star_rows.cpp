#include "content/stars/star_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "content/files/printable.h"
#include "content/stars/column_names.h"
#include "content/stars/sky_angle.h"
#include "content/stars/star_colour.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t max_stars = 100'000'000;

//! An object at distance 0 with a magnitude below this is the Sun. Catalogs also write a distance
//! of 0 for stars with an unknown distance.
constexpr double brightest_but_the_sun = -20.0;

//! Maximum absolute color; catalogs write 99 for an unknown one.
constexpr double max_colour = 20.0;

constexpr double max_hours = 24.0;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

//! Returns true if a cell marks an unknown number in Gaia's archive, VizieR, SIMBAD or AstroPy.
bool is_blank(std::string_view cell) {
  constexpr std::string_view blanks[] = {"",    "null", "NULL", "nan",  "NaN", "NAN", "--", "---",
                                         "N/A", "n/a",  "NA",   "None", "~",   "...", "\\N"};
  return std::ranges::find(blanks, cell) != std::end(blanks);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view spaces = " \t";
  const std::size_t first = text.find_first_not_of(spaces);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(spaces) - first + 1);
}

double known_colour(double colour) { return std::abs(colour) <= max_colour ? colour : missing; }

}  // namespace

void StarRows::begin(TableColumns columns, char separator) {
  columns_ = std::move(columns);
  separator_ = separator;
}

std::string StarRows::location(std::size_t line) const { return fmt::format("{}:{}", file_, line); }

void StarRows::refuse(const std::string& cell, Quantity quantity, std::size_t line) const {
  if (cell.find('\n') != std::string::npos) {
    throw Error(location(line),
                fmt::format("has a cell that spans several lines where {} is expected", words_of(quantity)),
                "close its quotation marks");
  }
  const bool coordinate = quantity == right_ascension || quantity == declination;
  throw Error(location(line),
              fmt::format("has \"{}\" where {} is expected", printable(std::string_view(cell).substr(0, 40)),
                          words_of(quantity)),
              coordinate
                  ? "write a number, or hours (degrees), minutes and seconds such as 05:14:32.27, or leave it empty"
                  : "write a number, or leave it empty");
}

std::string StarRows::number_text(const std::string& cell) const {
  std::string text(trimmed(cell));
  if (is_blank(text)) {
    return "";
  }
  // Commas that do not separate cells are decimal points.
  if (separator_ != ',' && std::ranges::count(text, ',') == 1 && text.find('.') == std::string::npos) {
    std::ranges::replace(text, ',', '.');
  }
  return text;
}

double StarRows::number(const RowCells& cells, Quantity quantity, std::size_t line) const {
  const std::string text = number_text(cells[quantity]);
  if (text.empty()) {
    return missing;
  }
  const char* const first = text.data() + (text.front() == '+' ? 1 : 0);
  const char* const last = text.data() + text.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error == std::errc() && end == last) {
    return value;
  }
  // A catalog number is only a star's name and may be any text.
  if (quantity == catalogue_number) {
    return missing;
  }
  refuse(cells[quantity], quantity, line);
}

double StarRows::right_ascension_of(const std::string& text, const std::string& cell, std::size_t line) {
  const auto angle = parse_sky_angle(text);
  if (!angle) {
    refuse(cell, right_ascension, line);
  }
  if (!angle->sexagesimal && angle->mark == AngleMark::none) {
    decimal_ = true;
    largest_ra_ = std::max(largest_ra_, std::abs(angle->value));
    return angle->value;
  }
  sexagesimal_ = true;
  const bool in_degrees = columns_.ra.unit == AngleUnit::degrees && columns_.ra.source == UnitSource::units_row;
  const bool named_degrees = plain_column_name(columns_.names[right_ascension]).ends_with("deg");
  if (angle->mark == AngleMark::none && (in_degrees || named_degrees)) {
    throw Error(location(line), fmt::format("has \"{}\" in a column of degrees", printable(cell.substr(0, 40))),
                "write decimal degrees, or mark the units as in 05h14m32.27s or 78d38m04s");
  }
  const double ra_deg = angle->mark == AngleMark::degrees ? angle->value : 15.0 * angle->value;
  if (std::abs(ra_deg) > 360.0) {
    throw Error(location(line), fmt::format("has a right ascension of {}", printable(cell.substr(0, 40))),
                "write at most 24 hours or 360 degrees");
  }
  return ra_deg;
}

double StarRows::declination_of(const std::string& text, const std::string& cell, std::size_t line) const {
  const auto angle = parse_sky_angle(text);
  const bool radians = columns_.dec.unit == AngleUnit::radians;
  if (!angle || angle->mark == AngleMark::hours || (radians && angle->sexagesimal)) {
    refuse(cell, declination, line);
  }
  const double dec_deg = radians ? angle->value * radian_deg : angle->value;
  if (std::isfinite(dec_deg) && std::abs(dec_deg) > 90.0) {
    throw Error(location(line), fmt::format("has a declination of {} deg", dec_deg), "write -90 to 90 degrees");
  }
  return dec_deg;
}

StarRows::Coordinates StarRows::coordinates(const RowCells& cells, std::size_t line) {
  const std::string ra = number_text(cells[right_ascension]);
  const std::string dec = number_text(cells[declination]);
  return {ra.empty() ? missing : right_ascension_of(ra, cells[right_ascension], line),
          dec.empty() ? missing : declination_of(dec, cells[declination], line)};
}

double StarRows::colour(const RowCells& cells, std::size_t line) {
  const auto take = [&](Quantity quantity, double b_v) {
    used_[quantity] = used_[quantity] || std::isfinite(b_v);
    return b_v;
  };
  const auto difference = [&](Quantity blue, Quantity red) {
    return known_colour(number(cells, blue, line) - number(cells, red, line));
  };
  double b_v = take(b_v_colour, known_colour(number(cells, b_v_colour, line)));
  if (std::isnan(b_v)) {
    b_v = take(bp_rp_colour, b_v_from_bp_rp(known_colour(number(cells, bp_rp_colour, line))));
  }
  if (std::isnan(b_v)) {
    b_v = take(bp_magnitude, b_v_from_bp_rp(difference(bp_magnitude, rp_magnitude)));
  }
  if (std::isnan(b_v)) {
    b_v = take(bt_magnitude, b_v_from_tycho(number(cells, bt_magnitude, line), number(cells, vt_magnitude, line)));
  }
  return std::isnan(b_v) ? take(star_temperature_k, b_v_from_temperature(number(cells, star_temperature_k, line)))
                         : b_v;
}

double StarRows::magnitude(const RowCells& cells, std::size_t line) {
  const auto take = [&](Quantity quantity, double v_mag) {
    used_[quantity] = used_[quantity] || std::isfinite(v_mag);
    return v_mag;
  };
  double v_mag = take(v_magnitude, number(cells, v_magnitude, line));
  if (std::isnan(v_mag)) {
    double bp_rp = known_colour(number(cells, bp_rp_colour, line));
    if (std::isnan(bp_rp)) {
      bp_rp = known_colour(number(cells, bp_magnitude, line) - number(cells, rp_magnitude, line));
    }
    v_mag = take(g_magnitude, v_from_gaia(number(cells, g_magnitude, line), bp_rp));
  }
  return std::isnan(v_mag)
             ? take(vt_magnitude, v_from_tycho(number(cells, bt_magnitude, line), number(cells, vt_magnitude, line)))
             : v_mag;
}

void StarRows::take(const RowCells& cells, std::size_t line) {
  const Coordinates at = coordinates(cells, line);
  const double v_mag = magnitude(cells, line);
  const double b_v = colour(cells, line);
  if (!std::isfinite(at.ra) || !std::isfinite(at.dec_deg)) {
    return leave_out({"without a position", 1, line, false});
  }
  if (!std::isfinite(v_mag)) {
    return leave_out({"without a magnitude", 1, line, false});
  }
  // The magnitude is checked too, because catalogs also have a distance of 0 for stars whose
  // distance is unknown.
  if (number(cells, sun_distance, line) == 0.0 && v_mag < brightest_but_the_sun) {
    return leave_out({"for the Sun", 1, line, true});
  }
  const bool in_hours = columns_.ra.unit == AngleUnit::hours && columns_.ra.source != UnitSource::program;
  if (std::abs(at.ra) > 360.0 || (in_hours && decimal_ && std::abs(at.ra) > max_hours)) {
    throw Error(location(line), fmt::format("has a right ascension of {} {}", at.ra, in_hours ? "h" : "deg"),
                "write at most 24 hours or 360 degrees, and name the column ra_hours or ra_deg");
  }
  if (sexagesimal_ && decimal_) {
    throw Error(location(line), "mixes decimal and sexagesimal right ascensions in one column",
                "write all of them in one form");
  }
  if (v_mag < -30.0 || v_mag > 60.0) {
    throw Error(location(line), fmt::format("has a magnitude of {}", v_mag), "write -30 to 60");
  }
  if (catalogue_.stars.size() >= max_stars) {
    throw Error(location(line), "has more than 100 million stars", "remove the faintest ones");
  }
  const double own = number(cells, catalogue_number, line);
  const bool counted = own >= 0.0 && own <= 4e9;
  catalogue_.stars.push_back({counted ? static_cast<std::uint32_t>(own) : 0U, at.ra, at.dec_deg,
                              static_cast<float>(v_mag), static_cast<float>(b_v)});
}

bool StarRows::take_units(const RowCells& cells, std::size_t line) {
  const auto unit = [&](Quantity quantity) { return trimmed(cells[quantity]); };
  if (!angle_unit_named(unit(right_ascension)) || !angle_unit_named(unit(declination))) {
    return false;
  }
  for (int quantity = 0; quantity < quantity_count; ++quantity) {
    if (columns_.has(static_cast<Quantity>(quantity))) {
      apply_unit(columns_, static_cast<Quantity>(quantity), unit(static_cast<Quantity>(quantity)),
                 UnitSource::units_row, location(line));
    }
  }
  return true;
}

void StarRows::leave_out(const RowsLeftOut& rows) {
  const auto known = std::ranges::find(catalogue_.left_out, rows.why, &RowsLeftOut::why);
  if (known == catalogue_.left_out.end()) {
    catalogue_.left_out.push_back(rows);
  } else {
    known->count += rows.count;
  }
}

void StarRows::decide_unit() {
  const bool undecided = columns_.ra.unit == AngleUnit::open || columns_.ra.source == UnitSource::program;
  if (undecided && largest_ra_ > max_hours) {
    columns_.ra = {AngleUnit::degrees, UnitSource::values};
  } else if (columns_.ra.unit == AngleUnit::open) {
    columns_.ra = {AngleUnit::hours, UnitSource::values};
  }
}

std::string StarRows::how_read() const {
  const auto name = [&](Quantity quantity) {
    return printable(std::string_view(columns_.names[quantity]).substr(0, 40));
  };
  std::string text = name(right_ascension);
  if (sexagesimal_) {
    text += " in sexagesimal form";
  } else {
    constexpr const char* units[] = {"", "degrees", "hours", "radians"};
    text += fmt::format(" in {}", units[static_cast<int>(columns_.ra.unit)]);
    if (columns_.ra.source == UnitSource::program) {
      text += fmt::format(" (columns named as in {})", columns_.program);
    } else if (columns_.ra.source == UnitSource::values) {
      text += columns_.ra.unit == AngleUnit::degrees
                  ? " (values above 24)"
                  : " (assumed, as no value is above 24; rename it ra_deg if it is in degrees)";
    }
  }
  text += fmt::format(", {}", name(declination));
  const auto add = [&](const char* what, std::initializer_list<Quantity> quantities) {
    std::string from;
    for (const Quantity quantity : quantities) {
      from += used_[quantity] ? fmt::format("{}{}", from.empty() ? "" : " or ", name(quantity)) : "";
    }
    text += from.empty() ? "" : fmt::format("; {} from {}", what, from);
  };
  add("V", {v_magnitude, g_magnitude, vt_magnitude});
  add("color", {b_v_colour, bp_rp_colour, bp_magnitude, bt_magnitude, star_temperature_k});
  return text;
}

StarCatalogue StarRows::finish() {
  decide_unit();
  constexpr double degrees_per_unit[] = {1.0, 1.0, 15.0, radian_deg};
  const double scale = sexagesimal_ ? 1.0 : degrees_per_unit[static_cast<int>(columns_.ra.unit)];
  for (CatalogueStar& star : catalogue_.stars) {
    star.ra_deg = std::fmod(std::fmod(scale * star.ra_deg, 360.0) + 360.0, 360.0);
  }
  sort_by_brightness(catalogue_.stars);
  if (!catalogue_.stars.empty()) {
    catalogue_.read_as = how_read();
  }
  return std::move(catalogue_);
}

}  // namespace ergodome
