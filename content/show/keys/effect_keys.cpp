#include <fmt/format.h>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr auto unused_without_stars = [](const Show& show, const auto& /*settings*/) {
  return show.sky.stars.empty() ? "has no effect without sky.stars" : nullptr;
};

constexpr auto unused_with_pattern = [](const Show& show, const DiffractionSettings& spikes) {
  return show.sky.stars.empty() || spikes.pattern.empty() ? nullptr : "is replaced by effects.diffraction.pattern";
};

constexpr const char* no_fractions = "a whole number cannot change gradually";

constexpr auto psf_keys = keys_of<PointSpreadSettings>(
    key<&PointSpreadSettings::sigma_px>("sigma_px", "Spread of a star image. 0: one hard pixel.")
        .range(0.0, 100.0, "px")
        .animated(changes_stars),
    key<&PointSpreadSettings::cutoff_px>("cutoff_px", "Radius at which the spot ends. 0: three times `sigma_px`.")
        .range(0.0, 100.0, "px")
        .animated(changes_stars));

constexpr auto trail_keys = keys_of<TrailSettings>(
    key<&TrailSettings::shutter_s>("shutter_s", "Time that the shutter is open, half of it before the frame's time.")
        .range(0.0, 1e6, "s")
        .animated());

constexpr auto diffraction_keys = keys_of<DiffractionSettings>(
    key<&DiffractionSettings::brighter_than_mag>("brighter_than_mag", "Star images at least this bright have spikes.")
        .range(-40.0, 40.0, "mag")
        .animated(changes_stars),
    key<&DiffractionSettings::strength>("strength", "Part of a star's light that is in the spikes.")
        .range(0.0, 1.0)
        .animated(changes_stars),
    key<&DiffractionSettings::pattern>("pattern", "Image of the pattern, in place of an aperture.")
        .page({.type = "path", .otherwise = "absent", .bounds = "up to 1025 x 1025 px"}),
    key<&DiffractionSettings::blades>("blades", "Sides of the aperture. 0: round.")
        .range(0, 64)
        .fixed(no_fractions)
        .unused_if(unused_with_pattern)
        .after([](TomlTable& table, DiffractionSettings& spikes) {
          if (spikes.blades == 1 || spikes.blades == 2) {
            throw table.error_at("blades", fmt::format("is {}, but an aperture has at least 3 blades", spikes.blades),
                                 "choose 3 or more, or 0 for a round aperture");
          }
        })
        .page({.bounds = "0, 3 to 64"}),
    key<&DiffractionSettings::vanes>("vanes", "Arms that hold a secondary mirror, the first one upwards.")
        .range(0, 64)
        .fixed(no_fractions)
        .unused_if(unused_with_pattern),
    key<&DiffractionSettings::obstruction>("obstruction", "Radius of a central mirror, relative to the aperture.")
        .range(0.0, 0.9)
        .animated(changes_stars)
        .unused_if(unused_with_pattern),
    key<&DiffractionSettings::size_px>("size_px", "Width of the pattern.")
        .range(3, 1025, "px")
        .fixed(no_fractions)
        .unused_if(unused_with_pattern)
        .after([](TomlTable& table, DiffractionSettings& spikes) {
          if (spikes.size_px % 2 == 0) {
            throw table.error_at("size_px", fmt::format("is {}, but the pattern needs a middle pixel", spikes.size_px),
                                 "choose an odd number");
          }
        })
        .page({.bounds = "odd, 3 to 1025"}),
    key<&DiffractionSettings::scale>("scale",
                                     "Radius of a round aperture's first dark ring at 550 nm, in units of 2 px.")
        .range(0.25, 8.0)
        .animated(changes_stars)
        .unused_if(unused_with_pattern));

constexpr auto bloom_keys = keys_of<BloomSettings>(
    key<&BloomSettings::strength>("strength", "Part of the light that is scattered.").range(0.0, 1.0).animated(),
    key<&BloomSettings::radius_px>("radius_px", "Root mean square distance of the scattered light along an axis.")
        .range(0.0, 4096.0, "px")
        .animated());

constexpr auto keys_of_effects = keys_of<EffectSettings>(
    key<&EffectSettings::redshift>(
        "redshift",
        "Frequency shift of stars, map, disk, shells and traced objects. A star of temperature T looks like a "
        "blackbody of g T, where g is the ratio of the observed frequency to the emitted one."),
    key<&EffectSettings::magnification>("magnification", "Star images are as bright as the lens makes them.")
        .unused_if(unused_without_stars),
    table<&EffectSettings::psf>("psf", psf_keys).unused_if(unused_without_stars),
    table<&EffectSettings::trails>("trails", trail_keys, "Light trails of moving stars. An empty table is enough.")
        .unused_if(unused_without_stars),
    table<&EffectSettings::diffraction>("diffraction", diffraction_keys, "Spikes on bright stars.")
        .unused_if(unused_without_stars),
    table<&EffectSettings::bloom>("bloom", bloom_keys, "Halo around bright light. The total light stays the same."));

}  // namespace

constinit const KeyTable<EffectSettings> effect_keys = keys_of_effects;

}  // namespace ergodome
