#pragma once

#include "content/show/stereo_eyes.h"
#include "render/plan/plan_writer.h"

namespace ergodome {

void plan_flat_shadow(PlanWriter& plan);

//! The shadow that each of two eyes sees if they share a camera.
inline constexpr PassKind flat_shadow_kind = {"flat_shadow", PassStage::frame,
                                              [](const Show& show, ViewMode) { return share_camera(show.stereo); },
                                              plan_flat_shadow};

}  // namespace ergodome
