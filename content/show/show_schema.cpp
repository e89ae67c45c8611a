#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::array scheme_names = {"conforming", "quadtree"};

constexpr auto hole_keys = keys_of<Show>(key<&Show::spin>("spin").range(-1.0, 1.0).unit("M").animated().means(
    "Spin of the hole, a/M. See the [conditions for animated numbers](#conditions-for-animated-numbers)."));

constexpr auto grid_keys = keys_of<Show>(
    key<&Show::grid_scheme>("scheme")
        .words(scheme_names)
        .means("Kind of [lens grid](../explanation/grids.md). `quadtree` is a published grid, for comparison."));

constexpr auto quality_keys = keys_of<QualitySettings>(
    key<&QualitySettings::budget_px>("budget_px")
        .range(1e-6, 100.0)
        .unit("px")
        .fixed("a show is baked for a single budget")
        .means("Accepted error of the lens on the screen. A smaller budget loses fewer faint star images at the "
               "shadow's edge."));

constexpr auto readout_keys = keys_of<ReadoutSettings>(
    key<&ReadoutSettings::place, &DomePlace::azimuth_deg>("azimuth_deg")
        .range(-360.0, 360.0)
        .unit("deg")
        .means("As for captions."),
    key<&ReadoutSettings::place, &DomePlace::elevation_deg>("elevation_deg")
        .range(-90.0, 90.0)
        .unit("deg")
        .means("As for captions."),
    key<&ReadoutSettings::letter_deg>("letter_deg").range(0.05, 45.0).unit("deg").means("Height of the line."));

}  // namespace

std::span<const ShowKey> show_keys() {
  static const auto all =
      keys_of<Show>(group<Show>("hole", hole_keys), table<&Show::effects>("effects", effect_keys),
                    table<&Show::stereo>("stereo", stereo_keys), table<&Show::tone>("tone", tone_keys),
                    table<&Show::flight>("flight", flight_keys), group<Show>("grid", grid_keys),
                    table<&Show::quality>("quality", quality_keys), table<&Show::readout>("readout", readout_keys));
  return all.keys;
}

}  // namespace ergodome
