#include "content/effects_reader.h"

#include "content/files/toml_table.h"

namespace ergodome {

namespace {

DiffractionSettings read_diffraction(const toml::table& table, const std::string& file) {
  TomlTable reader(table, file, "effects.diffraction");
  DiffractionSettings spikes;
  spikes.brighter_than_mag = reader.number("brighter_than_mag", spikes.brighter_than_mag, -40.0, 40.0);
  spikes.strength = reader.number("strength", spikes.strength, 0.0, 1.0);
  spikes.pattern = reader.text("pattern", spikes.pattern);
  spikes.blades = reader.integer("blades", spikes.blades, 0, 64);
  spikes.vanes = reader.integer("vanes", spikes.vanes, 0, 64);
  spikes.obstruction = reader.number("obstruction", spikes.obstruction, 0.0, 0.9);
  spikes.size_px = reader.integer("size_px", spikes.size_px, 3, 1025);
  spikes.scale = reader.number("scale", spikes.scale, 0.25, 8.0);
  if (spikes.blades == 1 || spikes.blades == 2) {
    throw reader.error_at("blades", "make no aperture", "choose 0 for a round one, or 3 and more");
  }
  if (spikes.size_px % 2 == 0) {
    throw reader.error_at("size_px", "is even: the pattern has no middle", "choose an odd width");
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
    effects.psf =
        PointSpreadSettings{spread.number("sigma_px", 0.5, 0.01, 100.0), spread.number("cutoff_px", 0.0, 0.0, 100.0)};
    spread.refuse_unknown_keys();
  }
  if (const toml::table* trails = reader.table("trails")) {
    TomlTable shutter(*trails, file, "effects.trails");
    effects.trails = TrailSettings{shutter.number("shutter_s", 0.02, 0.0, 1e6)};
    shutter.refuse_unknown_keys();
  }
  if (const toml::table* spikes = reader.table("diffraction")) {
    effects.diffraction = read_diffraction(*spikes, file);
  }
  if (const toml::table* bloom = reader.table("bloom")) {
    TomlTable halo(*bloom, file, "effects.bloom");
    effects.bloom = BloomSettings{halo.number("strength", 0.04, 0.0, 1.0), halo.number("radius_px", 40.0, 0.0, 4096.0)};
    halo.refuse_unknown_keys();
  }
  reader.refuse_unknown_keys();
}

void read_tone(const toml::table& table, const std::string& file, ToneSettings& tone) {
  TomlTable reader(table, file, "tone");
  tone.curve = static_cast<ToneCurve>(reader.choice("curve", 0, {"shoulder", "reinhard", "filmic", "gamma"}));
  tone.exposure_stops = reader.number("exposure_stops", 0.0, -40.0, 40.0);
  tone.white = reader.number("white", tone.white, 1e-3, 1e6);
  tone.gamma = reader.number("gamma", tone.gamma, 0.1, 10.0);
  if (const toml::table* follow = reader.table("auto")) {
    TomlTable automatic(*follow, file, "tone.auto");
    AutoExposureSettings settings;
    settings.target = automatic.number("target", settings.target, 1e-4, 1.0);
    settings.least_stops = automatic.number("least_stops", settings.least_stops, -40.0, 40.0);
    settings.most_stops = automatic.number("most_stops", settings.most_stops, settings.least_stops, 40.0);
    settings.adapt_s = automatic.number("adapt_s", settings.adapt_s, 0.0, 1e3);
    automatic.refuse_unknown_keys();
    tone.automatic = settings;
  }
  reader.refuse_unknown_keys();
}

}  // namespace ergodome
