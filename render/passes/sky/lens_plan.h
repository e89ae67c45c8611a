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

//! Adds the possible lenses of a picture to the plan, in the order in which LensChooser tries them.
void plan_lens(PlanWriter& plan, const LensChannels& channels, const ShellsFollowed& shells);

//! Adds the building of a lens grid, at each new position of the camera, to the plan.
void plan_grid(PlanWriter& plan, const std::string& reason, bool if_needed);

}  // namespace ergodome
