#pragma once

#include <filesystem>
#include <string>

#include "calibration/formats/mpcdi/mpcdi.h"

namespace ergodome {

//! Returns a calibration as the bytes of an archive, in its version and profile. The function
//! parse_mpcdi_archive() reads it back unchanged. Maps begin with the bottom row. Throws Error,
//! which names `name`, if a region lacks what the profile requires (a warp, a frustum, a frame), or
//! if an id is empty or used twice.
//!
//! A region without a warp or mask gets an empty <path>, like that of programs that transfer these
//! in other ways.
std::string to_mpcdi_archive(const Mpcdi& mpcdi, const std::string& name);

//! Writes a calibration to a file atomically.
void write_mpcdi(const std::filesystem::path& path, const Mpcdi& mpcdi);

}  // namespace ergodome
