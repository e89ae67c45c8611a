#pragma once

#include <vector>

#include "calibration/projectors/projector_files.h"

namespace ergodome {

//! Returns a setup without the names of files that only contain what lenses and poses of the
//! projectors determine, because these can be recomputed after a change of the dome. They are warps
//! of domemasters (with a mask beside them) whose nodes agree with where the light meets the dome,
//! and masks of these projectors that the default BlendSettings produce. Files that differ, such as
//! external calibrations or manually moved corners, keep their names. `loaded` contains the result
//! of load_projector() for each projector.
DomeSetup without_computed_files(const DomeSetup& setup, const std::vector<LoadedProjector>& loaded);

}  // namespace ergodome
