#pragma once

#include <string>

#include "render/passes/sky/sky_shading.h"
#include "render/plan/plan_writer.h"

namespace ergodome {

//! Whether a picture's rays are followed to visible shells.
struct ShellsFollowed {
  bool at_most;  //!< true if rays are followed to shells at some time of the show
  bool always;
};

//! Whether the lens of a picture shades it (LensSource::shade()).
enum class ShadedByLens { never, possibly, always };

//! Adds the possible lenses of a picture to the plan, in the order in which LensChooser tries them.
//! Lenses that shade pictures are left to the plan of the shading.
ShadedByLens plan_lens(PlanWriter& plan, const SkyShading& shading, const ShellsFollowed& shells);

//! Adds the building of a lens grid, at each new position of the camera, to the plan.
void plan_grid(PlanWriter& plan, const std::string& reason, bool if_needed);

}  // namespace ergodome
