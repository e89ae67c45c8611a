#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/grid_offsets.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! Returns a base name for a projector's files: its number, from 1, and its name, in which
//! characters other than letters, digits and - become _. `index` counts from 0.
std::string projector_file_name(std::size_t index, const std::string& name);

//! Writes the calibration of projectors into a folder: a Bourke mesh and masks (PNG, linear) for
//! each, and a setup that names them. `pictures` are those of `setup`, in its order; `file_name` is
//! the name of the new setup, which has no rotation, because the meshes contain it. Keeps older
//! meshes and masks as .bak. Returns the new setup's path.
std::filesystem::path write_projector_folder(const std::filesystem::path& folder, const std::string& file_name,
                                             DomeSetup setup, const std::vector<ProjectorPicture>& pictures);

//! Writes a setup to `file`. For each projector with offsets, and for those marked in `anew`
//! (empty: none), also writes its moved warp (Bourke mesh) and masks to the setup's folder:
//! N_NAME.data, N_NAME_blend.png and, with offsets, N_NAME_black.png. Keeps older files with these
//! names as .bak, and all files that the setup named before. Returns the setup as written, whose
//! warps contain the offsets. Throws Error if a file cannot be written; if that can be detected
//! beforehand, writes nothing.
DomeSetup save_calibration(const std::filesystem::path& file, const DomeSetup& setup,
                           const std::vector<GridOffsets>& offsets, const std::vector<bool>& anew = {});

}  // namespace ergodome
