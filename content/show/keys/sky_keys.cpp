#include "content/show/show_schema.h"
#include "content/sky/sky_map.h"

namespace ergodome {

namespace {

constexpr std::array coordinate_names = {"equatorial", "galactic", "ecliptic"};
constexpr std::array filter_names = {"ewa", "point", "polygon"};
constexpr std::array shift_names = {"luminance", "blackbody_fit"};
constexpr std::array method_names = {"inverse", "gather"};

constexpr auto layout_keys = keys_of<MapLayout>(
    key<&MapLayout::coordinates>("coordinates", "Coordinates of the map (J2000).").words(coordinate_names),
    key<&MapLayout::middle_deg>("middle_deg", "Longitude in the middle of the image.")
        .range(-360.0, 360.0, "deg")
        .before([](TomlTable& /*table*/, MapLayout& layout) {
          // The default is 270°, as in the built-in map, or 0°: the galactic center or the vernal
          // equinox.
          layout.middle_deg = layout.coordinates == MapCoordinates::equatorial ? MapLayout{}.middle_deg : 0.0;
        })
        .page({.otherwise = "270 for equatorial, else 0"}),
    key<&MapLayout::mirrored>("mirrored", "`true`: longitude grows to the right."));

constexpr auto axis_keys =
    keys_of<SkySettings>(key<&SkySettings::spin_axis_ra_deg>("ra_deg", "Right ascension (J2000) of the spin axis.")
                             .range(-360.0, 360.0, "deg")
                             .animated(changes_sky),
                         key<&SkySettings::spin_axis_dec_deg>("dec_deg", "Declination (J2000) of the spin axis.")
                             .range(-90.0, 90.0, "deg")
                             .animated(changes_sky));

constexpr auto unused_on_black = [](const Show& /*show*/, const SkySettings& sky) {
  return sky.map == "black" ? "has no effect on map = \"black\"" : nullptr;
};

constexpr auto unused_without_light = [](const Show& /*show*/, const SkySettings& sky) {
  return sky.map == "black" && sky.stars.empty() ? "has no effect without stars on map = \"black\"" : nullptr;
};

constexpr auto unused_for_no_stars = [](const Show& /*show*/, const SkySettings& sky) {
  return sky.stars.empty() ? "has no effect without sky.stars" : nullptr;
};

constexpr auto keys_of_sky = keys_of<SkySettings>(
    key<&SkySettings::map>("map", "Map of the sky. See [sky images](sky-images.md) for formats, layers and cube maps.")
        .page({.bounds = "`\"milky_way\"`, `\"grid\"`, `\"black\"`, or a path"}),
    table<&SkySettings::map_layout>("map_layout", layout_keys,
                                    "Coordinates of your own map. Not allowed with a built-in map.")
        .before([](TomlTable& table, SkySettings& sky) {
          if (table.table("map_layout") != nullptr && is_built_in_sky(sky.map)) {
            throw table.error_at("map_layout", "cannot be used with the built-in map \"" + sky.map + "\"",
                                 "remove it, or give the path of an image as map");
          }
        })
        .written_if([](const SkySettings& sky) { return sky.map_layout != MapLayout{}; })
        .page({.otherwise = "that of the built-in map"}),
    key<&SkySettings::stars>(
        "stars", "Star catalog. See [star tables](star-tables.md). `bright_stars` has the stars up to magnitude 6.5.")
        .page({.otherwise = "absent: no stars", .bounds = "`\"bright_stars\"`, `\"all_stars\"`, or a path"}),
    key<&SkySettings::faintest_mag>("faintest_mag", "Star images that appear fainter than this are left out.")
        .range(-30.0, 60.0, "mag")
        .animated(changes_stars)
        .unused_if(unused_for_no_stars),
    key<&SkySettings::exposure>("exposure", "Factor on the light of map and stars.")
        .range(0.0, 1e12)
        .animated(changes_stars)
        .unused_if(unused_without_light),
    group<SkySettings>("spin_axis", axis_keys).unused_if([](const Show& show, const SkySettings& sky) {
      return sky.map == "grid" ? "has no effect on map = \"grid\", which uses the hole's own axes"
                               : unused_without_light(show, sky);
    }),
    key<&SkySettings::filter>("filter", "How a pixel samples the map. See below.")
        .words(filter_names)
        .unused_if(unused_on_black),
    key<&SkySettings::shift>("shift", "Effect of `effects.redshift` on the map. See below.")
        .words(shift_names)
        .first(SkyShift::luminance)
        .unused_if([](const Show& show, const SkySettings& sky) {
          const char* const black = unused_on_black(show, sky);
          return black == nullptr && !show.effects.redshift ? "is used only with effects.redshift = true" : black;
        }),
    key<&SkySettings::brightening>("brightening", "`true`: the map's light is multiplied by the magnification.")
        .unused_if(unused_on_black));

constexpr auto keys_of_stars = keys_of<SkySettings>(
    key<&SkySettings::star_method>(
        "method",
        "`inverse` finds every image of each star. `gather` takes the stars that each pixel covers; it is less "
        "exact, and is there for comparison.")
        .words(method_names)
        .unused_if(unused_for_no_stars));

}  // namespace

constinit const KeyTable<SkySettings> sky_keys = keys_of_sky;
constinit const KeyTable<SkySettings> star_keys = keys_of_stars;

}  // namespace ergodome
