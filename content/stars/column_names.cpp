#include "content/stars/column_names.h"

#include <algorithm>
#include <iterator>

namespace ergodome {

namespace {

//! Column names in order of preference: our own, then those of VizieR, Gaia's archive, HYG and
//! others.
constexpr KnownName known_names[] = {
    {"ra_deg", right_ascension, 0, AngleUnit::degrees},
    {"radeg", right_ascension, 1, AngleUnit::degrees},
    {"_raj2000", right_ascension, 2, AngleUnit::degrees},
    {"_ra_icrs", right_ascension, 3, AngleUnit::degrees},
    {"_ra", right_ascension, 4, AngleUnit::degrees},
    {"ra_icrs", right_ascension, 5, AngleUnit::degrees},
    {"raicrs", right_ascension, 6, AngleUnit::degrees},
    {"raj2000", right_ascension, 7, AngleUnit::degrees},
    {"ramdeg", right_ascension, 8, AngleUnit::degrees},
    {"ra_hours", right_ascension, 9, AngleUnit::hours},
    {"rahms", right_ascension, 10, AngleUnit::hours},
    {"ra_j2000", right_ascension, 11},
    {"ra", right_ascension, 12},
    {"right_ascension", right_ascension, 13},
    {"dec_deg", declination, 0},
    {"decdeg", declination, 0},
    {"dedeg", declination, 1},
    {"_dej2000", declination, 2},
    {"_de_icrs", declination, 3},
    {"_de", declination, 4},
    {"de_icrs", declination, 5},
    {"deicrs", declination, 6},
    {"dej2000", declination, 7},
    {"demdeg", declination, 8},
    {"dedms", declination, 10},
    {"dec_j2000", declination, 11},
    {"dec", declination, 12},
    {"de", declination, 12},
    {"decl", declination, 12},
    {"declination", declination, 13},
    {"v_mag", v_magnitude},
    {"vmag", v_magnitude},
    {"mag", v_magnitude},
    {"magnitude", v_magnitude},
    {"v", v_magnitude},
    {"hpmag", v_magnitude},
    {"phot_g_mean_mag", g_magnitude},
    {"gmag", g_magnitude},
    {"vtmag", vt_magnitude},
    {"b_v", b_v_colour},
    {"b_v_mag", b_v_colour},
    {"ci", b_v_colour},
    {"bp_rp", bp_rp_colour},
    {"phot_bp_mean_mag", bp_magnitude},
    {"bpmag", bp_magnitude},
    {"phot_rp_mean_mag", rp_magnitude},
    {"rpmag", rp_magnitude},
    {"btmag", bt_magnitude},
    {"teff", star_temperature_k},
    {"teff_gspphot", star_temperature_k},
    {"teff_val", star_temperature_k},
    {"temperature", star_temperature_k},
    {"hip", catalogue_number},
    {"id", catalogue_number},
    {"dist", sun_distance},
};

const Substitute substitutes[] = {
    {right_ascension, {"glon", "_glon", "gal_lon"}, "galactic coordinates"},
    {right_ascension, {"l", "b"}, "galactic coordinates"},
    {right_ascension, {"elon", "_elon", "ecl_lon"}, "ecliptic coordinates"},
    {right_ascension, {"rab1950", "_rab1950", "ra1950"}, "coordinates of the equinox B1950"},
    {right_ascension, {"rah", "ram"}, "a right ascension in several columns (RAh, RAm, RAs)"},
    {right_ascension, {"rarad", "ra_rad"}, "a right ascension in radians"},
    {v_magnitude, {"absmag", "abs_mag", "m_v"}, "absolute magnitudes"},
    {v_magnitude, {"phot_g_mean_flux", "fg", "flux"}, "fluxes"},
    {v_magnitude, {"bmag", "b_mag"}, "B magnitudes"},
    {v_magnitude, {"sloan_gmag"}, "magnitudes of the Sloan survey"},
    {v_magnitude, {"jmag", "kmag", "j_m", "k_m"}, "infrared magnitudes"},
};

}  // namespace

std::string_view column_name_to_use(Quantity quantity) {
  return std::ranges::find(known_names, quantity, &KnownName::quantity)->name;
}

std::span<const KnownName> known_column_names() { return known_names; }

std::span<const Substitute> column_substitutes() { return substitutes; }

std::string_view bracketed_unit(std::string_view name) {
  const std::size_t open = name.find_first_of("([");
  if (open == std::string_view::npos || open == 0 || name.size() < open + 2 || name.find_last_of(")]") < open + 1) {
    return "";
  }
  return name.substr(open + 1, name.find_last_of(")]") - open - 1);
}

std::string plain_column_name(std::string_view name) {
  if (!bracketed_unit(name).empty()) {
    name = name.substr(0, name.find_first_of("(["));
  }
  constexpr std::string_view around = " \t#'\"()[].";
  const std::size_t first = name.find_first_not_of(around);
  if (first == std::string_view::npos) {
    return "";
  }
  std::string plain(name.substr(first, name.find_last_not_of(around) - first + 1));
  for (char& c : plain) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    c = c == ' ' || c == '-' || c == '.' ? '_' : c;
  }
  return plain;
}

std::optional<AngleUnit> angle_unit_named(std::string_view word) {
  struct UnitWord {
    std::string_view word;
    AngleUnit unit;
  };
  constexpr UnitWord words[] = {
      {"deg", AngleUnit::degrees},       {"degree", AngleUnit::degrees}, {"degrees", AngleUnit::degrees},
      {"Deg", AngleUnit::degrees},       {"\u00B0", AngleUnit::degrees}, {"d:m:s", AngleUnit::degrees},
      {"\"d:m:s\"", AngleUnit::degrees}, {"dms", AngleUnit::degrees},    {"h", AngleUnit::hours},
      {"hr", AngleUnit::hours},          {"hour", AngleUnit::hours},     {"hours", AngleUnit::hours},
      {"hourangle", AngleUnit::hours},   {"h:m:s", AngleUnit::hours},    {"\"h:m:s\"", AngleUnit::hours},
      {"hms", AngleUnit::hours},         {"hh:mm:ss", AngleUnit::hours}, {"h m s", AngleUnit::hours},
      {"dd:mm:ss", AngleUnit::degrees},  {"d m s", AngleUnit::degrees},  {"rad", AngleUnit::radians},
      {"radian", AngleUnit::radians},    {"radians", AngleUnit::radians}};
  const auto* const found = std::ranges::find(words, word, &UnitWord::word);
  return found == std::end(words) ? std::nullopt : std::optional(found->unit);
}

}  // namespace ergodome
