#include "content/sky/map_layout_reader.h"

#include "content/files/toml_table.h"

namespace ergodome {

namespace {

constexpr const char* coordinate_words[] = {"equatorial", "galactic", "ecliptic"};

//! Returns the usual longitude in the middle of maps in these coordinates: that of the built-in map
//! for equatorial ones, the galactic center, or the vernal equinox.
double usual_middle_deg(MapCoordinates coordinates) {
  return coordinates == MapCoordinates::equatorial ? MapLayout{}.middle_deg : 0.0;
}

}  // namespace

MapLayout read_map_layout(const toml::table& table, const std::string& file) {
  TomlTable reader(table, file, "sky.map_layout");
  MapLayout layout;
  layout.coordinates = static_cast<MapCoordinates>(
      reader.choice("coordinates", 0, {coordinate_words[0], coordinate_words[1], coordinate_words[2]}));
  layout.middle_deg = reader.number("middle_deg", usual_middle_deg(layout.coordinates), -360.0, 360.0);
  layout.mirrored = reader.boolean("mirrored", false);
  reader.refuse_unknown_keys();
  return layout;
}

toml::table map_layout_table(const MapLayout& layout) {
  return toml::table{{"coordinates", coordinate_words[static_cast<int>(layout.coordinates)]},
                     {"middle_deg", layout.middle_deg},
                     {"mirrored", layout.mirrored}};
}

}  // namespace ergodome
