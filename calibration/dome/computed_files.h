#pragma once

#include <vector>

#include "calibration/projectors/projector_files.h"

namespace ergodome {

//! A setup without the names of those files that hold what the projectors' lenses and places make, which can be made anew after a change of
//! the dome: warps of domemasters (with a mask named beside them) whose nodes lie where light meets the dome, and of these projectors masks
//! that the usual BlendSettings give. Files that differ, as those of an outside calibration or with corners moved by hand do, stay named.
//! `loaded`: what load_projector() makes of each projector.
DomeSetup without_computed_files(const DomeSetup& setup, const std::vector<LoadedProjector>& loaded);

}  // namespace ergodome
