#pragma once

#include <filesystem>
#include <string>

#include "calibration/formats/mpcdi/mpcdi.h"

namespace ergodome {

//! A calibration as the bytes of an archive, in the version and profile that it names; parse_mpcdi_archive reads it back the
//! same. Maps begin with the bottom row. Throws Error, naming `name`, where the profile needs what a region lacks (an alpha mask,
//! a frustum, a frame), and where two regions bear one id.
//!
//! A region without a warp or mask gets an empty <path>, as programs write that send these by other ways.
std::string to_mpcdi_archive(const Mpcdi& mpcdi, const std::string& name);

//! The same into a file, which is there whole or not at all.
void write_mpcdi(const std::filesystem::path& path, const Mpcdi& mpcdi);

}  // namespace ergodome
