#pragma once

#include <filesystem>
#include <vector>

#include "calibration/dome_setup.h"
#include "calibration/grid_offsets.h"

namespace ergodome {

//! Writes a setup, and for each projector whose corners were moved, or that is to have files anew (`anew`; absent: none), its warp (Bourke's mesh)
//! and masks as they then are, beside it: N_NAME.data, N_NAME_blend.png, N_NAME_black.png. Older files of all of these names are kept as .bak; files
//! that the setup named before stay. Returns the setup as written, whose warps hold the corners. Throws Error where a file cannot be written; where
//! that can be known beforehand, nothing is.
DomeSetup save_calibration(const std::filesystem::path& file, const DomeSetup& setup,
                           const std::vector<GridOffsets>& offsets, const std::vector<bool>& anew = {});

}  // namespace ergodome
