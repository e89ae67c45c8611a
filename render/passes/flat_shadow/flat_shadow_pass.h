#pragma once

#include "content/show/stereo_eyes.h"
#include "render/plan/plan_writer.h"

namespace ergodome {

void plan_flat_shadow(PlanWriter& plan);

//! Returns a pass for every show, because its eyes can be changed while it plays.
std::unique_ptr<Pass> make_flat_shadow_pass(const PassInput& input);

//! Darkens the picture where the eye sees the hole's shadow but its head does not, for two eyes
//! that share the head's camera (mask_shadow()).
inline constexpr PassKind flat_shadow_kind = {"flat_shadow",
                                              PassStage::near,
                                              [](const Show& show, ViewMode) { return share_camera(show.stereo); },
                                              plan_flat_shadow,
                                              make_flat_shadow_pass,
                                              /*serves_one_picture=*/false,
                                              /*in_host_memory=*/true};

}  // namespace ergodome
