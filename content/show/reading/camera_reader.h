#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads a show's [camera] table (nullptr if absent, which is an error), and computes its fall. The
//! hole, the animations and the fall (read_fall()) must have been read. Throws Error with file,
//! line and remedy for mistakes in the table, keys inside the horizon, and keys or path segments on
//! which the observer would be faster than light.
void read_camera(const toml::table* table, const std::string& file, Show& show);

//! Throws Error if an animated spin would put the camera inside the horizon. Checks this at the
//! keys of the spin and of the camera, and between them.
void check_spin_on_path(const std::string& file, const Show& show);

}  // namespace ergodome
