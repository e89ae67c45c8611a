#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! Adds the work for the lens, for the sky map and for its shading to the plan.
void plan_sky(PlanWriter& plan);

//! The pass that draws the sky, seen through the lens; every picture has it.
inline constexpr PassKind sky_kind = {"sky", PassStage::distant, [](const Show&, ViewMode) { return true; }, plan_sky};

}  // namespace ergodome
