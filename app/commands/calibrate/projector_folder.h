#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! A file's name for a projector, whatever the setup calls it: its number from 1, and what of its name is plain.
std::string projector_file_name(std::size_t index, const std::string& name);

//! Writes what projectors show into a folder, whatever form it was in: a mesh of Bourke's and masks (PNG, linear) for each, and a setup that
//! names them. `setup` is the one that the pictures are of; `file_name` what the new one is called. Returns the new setup's path.
std::filesystem::path write_projector_folder(const std::filesystem::path& folder, const std::string& file_name,
                                             DomeSetup setup, const std::vector<ProjectorPicture>& pictures);

}  // namespace ergodome
