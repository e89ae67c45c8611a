#pragma once

#include <string>
#include <string_view>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Two keys of one number, or of the camera, are at least so far apart [s].
inline constexpr double least_key_gap_s = 1e-6;

//! The baseline of StereoModel::omni fades over so much elevation at least [deg].
inline constexpr double least_fade_deg = 1.0;

//! Reads a text that is either a string or a table of strings by language tags. Throws Error where it is missing or empty.
LocalText read_local_text(TomlTable& table, const std::string& file, std::string_view key);

//! Reads [readout], which shows spin and camera position.
ReadoutSettings read_readout(const toml::table& table, const std::string& file);

//! Reads what a show does with time: [[animate]], [[chapter]], [[caption]], [[overlay]] and [[audio]]. All other numbers of the show, but
//! its camera, must have been read. Throws Error with file, line and key.
void read_timeline(TomlTable& root, const std::string& file, Show& show);

//! Throws Error where a spin that changes would have the camera inside the horizon: looked at on its keys, the camera's, and between.
void check_spin_on_path(const std::string& file, const Show& show);

}  // namespace ergodome
