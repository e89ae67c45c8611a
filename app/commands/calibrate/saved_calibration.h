#pragma once

#include <filesystem>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/grid_offsets.h"

namespace ergodome {

//! Writes a setup. For each projector with offsets, and for those marked in `anew` (empty: none),
//! also writes its moved warp (Bourke mesh) and masks to the same folder: N_NAME.data,
//! N_NAME_blend.png and N_NAME_black.png. Keeps older files with these names as .bak, and all files
//! that the setup named before. Returns the setup as written, whose warps contain the offsets.
//! Throws Error if a file cannot be written; if that can be detected beforehand, writes nothing.
DomeSetup save_calibration(const std::filesystem::path& file, const DomeSetup& setup,
                           const std::vector<GridOffsets>& offsets, const std::vector<bool>& anew = {});

}  // namespace ergodome
