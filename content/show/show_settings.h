#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Changes the tree of the show that was parsed from `file`, one setting after the other. Entries of arrays are counted from
//! 0: "camera.key.0.r=30". A value that is not TOML is a string, unless it begins as a TOML string, array or table does.
//! The new nodes name the setting as their source ("--set hole.spin"). Throws Error for a setting without a key or a value, for malformed TOML, and for a path that leads through
//! a single value or to an entry that an array does not have.
void apply_settings(toml::table& show, const ShowSettings& settings, const std::string& file);

}  // namespace ergodome
