#pragma once

#include <string>
#include <string_view>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Minimum distance of two keys of a number, or of the camera [s].
inline constexpr double least_key_gap_s = 1e-6;

//! Minimum elevation range over which the baseline of omnidirectional stereo fades [deg].
inline constexpr double least_fade_deg = 1.0;

//! Reads a text that is either a string or a table of strings by language tags. Throws Error if it
//! is missing or empty.
LocalText read_local_text(TomlTable& table, std::string_view key);

//! Reads [[animate]], [[chapter]], [[caption]], [[overlay]] and [[audio]]. All other numbers of the
//! show, except its camera, must have been read. Throws Error with file, line and key for invalid
//! values.
void read_timeline(TomlTable& root, const std::string& file, Show& show);

//! Throws Error if an animated spin would put the camera inside the horizon, checked at the keys of
//! both and between them.
void check_spin_on_path(const std::string& file, const Show& show);

}  // namespace ergodome
