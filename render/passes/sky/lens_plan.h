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

//! Plans the lens of a picture, in LensChooser's order of trying lenses.
void plan_lens(PlanWriter& plan, const LensChannels& channels, const ShellsFollowed& shells);

//! Plans a grid that is traced at each new position.
void plan_grid(PlanWriter& plan, const std::string& reason, bool if_needed);

}  // namespace ergodome
