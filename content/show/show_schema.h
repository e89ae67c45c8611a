#pragma once

#include "content/show/show_key.h"

// The tables of the show file. Each source file of a table declares its keys; show_schema.cpp puts
// them together.
namespace ergodome {

extern const KeyTable<DiskSettings> disk_keys;
extern const KeyTable<EffectSettings> effect_keys;
extern const KeyTable<FallSettings> fall_keys;
extern const KeyTable<FlightSettings> flight_keys;
extern const KeyTable<HeadsetSettings> headset_keys;
extern const KeyTable<PointLight> light_keys;
extern const KeyTable<NumberKey> number_key_keys;
extern const KeyTable<ObjectSettings> object_keys;
extern const KeyTable<ShellSettings> shell_keys;
extern const KeyTable<SkySettings> sky_keys;
extern const KeyTable<SkySettings> star_keys;
extern const KeyTable<StereoSettings> stereo_keys;
extern const KeyTable<Timeline> timeline_keys;
extern const KeyTable<ToneSettings> tone_keys;
extern const KeyTable<ViewSettings> view_keys;

KeyTable<CameraSettings> camera_keys();

//! Returns the keys of the whole file.
std::span<const ShowKey> show_keys();

//! Throws Error if the outer edge of the disk is not outside the inner one, or if at no time of the
//! show matter can exist at the inner edge.
void check_disk(const toml::table& table, const std::string& file, const Show& show);

//! Throws Error if the minimum radius of a shell during the show is inside the maximum radius of
//! the horizon, or too close to it, even if they are reached at different times.
void check_shells(TomlTable& root, const std::string& file, const Show& show);

}  // namespace ergodome
