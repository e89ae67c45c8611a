#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! Returns a base name for a projector's files: its number, from 1, and the safe characters of its
//! name.
std::string projector_file_name(std::size_t index, const std::string& name);

//! Writes what projectors show into a folder: a Bourke mesh and masks (PNG, linear) for each, and a
//! setup that names them. `setup` is the setup of the pictures; `file_name` is the name of the new
//! setup. Returns the new setup's path.
std::filesystem::path write_projector_folder(const std::filesystem::path& folder, const std::string& file_name,
                                             DomeSetup setup, const std::vector<ProjectorPicture>& pictures);

}  // namespace ergodome
