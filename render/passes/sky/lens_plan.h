#pragma once

#include <string>

#include "render/passes/sky/sky_shading.h"
#include "render/plan/plan_writer.h"

namespace ergodome {

//! When rays are followed to visible shells.
struct ShellsFollowed {
  bool at_most;  //!< at some time
  bool always;
};

//! Adds the lenses of a picture to the plan, in the order in which LensChooser tries them.
void plan_lens(PlanWriter& plan, const LensChannels& channels, const ShellsFollowed& shells);

//! Adds a grid that is traced at each new position to the plan.
void plan_grid(PlanWriter& plan, const std::string& reason, bool if_needed);

}  // namespace ergodome
