#include "content/show/effects_reader.h"

#include <fmt/format.h>

#include "content/files/toml_table.h"
#include "content/show/own_number.h"

namespace ergodome {

namespace {

DiffractionSettings read_diffraction(const toml::table& table, const std::string& file) {
  TomlTable reader(table, file, "effects.diffraction");
  DiffractionSettings spikes;
  spikes.brighter_than_mag = own_number(reader, "brighter_than_mag", spikes.brighter_than_mag);
  spikes.strength = own_number(reader, "strength", spikes.strength);
  spikes.pattern = reader.text("pattern", spikes.pattern);
  spikes.blades = reader.integer("blades", spikes.blades, 0, 64);
  spikes.vanes = reader.integer("vanes", spikes.vanes, 0, 64);
  spikes.obstruction = own_number(reader, "obstruction", spikes.obstruction);
  spikes.size_px = reader.integer("size_px", spikes.size_px, 3, 1025);
  spikes.scale = own_number(reader, "scale", spikes.scale);
  if (spikes.blades == 1 || spikes.blades == 2) {
    throw reader.error_at("blades", fmt::format("is {}, but an aperture has at least 3 blades", spikes.blades),
                          "choose 3 or more, or 0 for a round aperture");
  }
  if (spikes.size_px % 2 == 0) {
    throw reader.error_at("size_px", fmt::format("is {}, but the pattern needs a middle pixel", spikes.size_px),
                          "choose an odd number");
  }
  reader.refuse_unknown_keys();
  return spikes;
}

}  // namespace

void read_effects(const toml::table& table, const std::string& file, EffectSettings& effects) {
  TomlTable reader(table, file, "effects");
  effects.redshift = reader.boolean("redshift", false);
  effects.magnification = reader.boolean("magnification", false);
  if (const toml::table* psf = reader.table("psf")) {
    TomlTable spread(*psf, file, "effects.psf");
    effects.psf = {own_number(spread, "sigma_px", effects.psf.sigma_px),
                   own_number(spread, "cutoff_px", effects.psf.cutoff_px)};
    spread.refuse_unknown_keys();
  }
  if (const toml::table* trails = reader.table("trails")) {
    TomlTable shutter(*trails, file, "effects.trails");
    effects.trails = TrailSettings{own_number(shutter, "shutter_s", 0.02)};
    shutter.refuse_unknown_keys();
  }
  if (const toml::table* spikes = reader.table("diffraction")) {
    effects.diffraction = read_diffraction(*spikes, file);
  }
  if (const toml::table* bloom = reader.table("bloom")) {
    TomlTable halo(*bloom, file, "effects.bloom");
    effects.bloom = BloomSettings{own_number(halo, "strength", 0.04), own_number(halo, "radius_px", 40.0)};
    halo.refuse_unknown_keys();
  }
  reader.refuse_unknown_keys();
}

void read_tone(const toml::table& table, const std::string& file, ToneSettings& tone) {
  TomlTable reader(table, file, "tone");
  tone.curve = static_cast<ToneCurve>(
      reader.choice("curve", 0, {tone_curve_names[0], tone_curve_names[1], tone_curve_names[2], tone_curve_names[3]}));
  tone.exposure_stops = own_number(reader, "exposure_stops", 0.0);
  tone.white = own_number(reader, "white", tone.white);
  tone.gamma = own_number(reader, "gamma", tone.gamma);
  if (const toml::table* follow = reader.table("auto")) {
    TomlTable automatic(*follow, file, "tone.auto");
    AutoExposureSettings settings;
    settings.target = own_number(automatic, "target", settings.target);
    settings.least_stops = own_number(automatic, "least_stops", settings.least_stops);
    settings.most_stops = own_number(automatic, "most_stops", settings.most_stops);
    if (settings.most_stops < settings.least_stops) {
      throw automatic.error_at("most_stops", fmt::format("is {}, below least_stops", settings.most_stops),
                               fmt::format("choose {} or more", settings.least_stops));
    }
    settings.adapt_s = own_number(automatic, "adapt_s", settings.adapt_s);
    automatic.refuse_unknown_keys();
    tone.automatic = settings;
  }
  reader.refuse_unknown_keys();
}

}  // namespace ergodome
