#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads a show's [camera], or its absence, into the show, whose hole has been read with what animates it. Throws Error with file, line and remedy
//! for what is wrong in it, for keys inside the horizon, and for keys and ways between them on which its observer would outrun light.
void read_camera(const toml::table* table, const std::string& file, Show& show);

}  // namespace ergodome
