#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Applies settings, in order, to the parsed tree of the show file `file`. Array entries are
//! counted from 0: "camera.key.0.r=30". A value that is not TOML is taken as a string, unless it
//! begins as a TOML string, array or table. The new nodes have the setting as their source ("--set
//! hole.spin"). Setting a number removes its animation. Throws Error for a setting without a key or
//! a value, for malformed TOML, and for a path through a single value or to a missing array entry.
void apply_settings(toml::table& show, const ShowSettings& settings, const std::string& file);

}  // namespace ergodome
