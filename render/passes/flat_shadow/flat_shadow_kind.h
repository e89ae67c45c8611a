#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! Returns whether both eyes use the head's lens, each from its own position.
inline bool eyes_are_flat(const Show& show, ViewMode /*mode*/) {
  return eye_count(show.stereo) > 1 && show.stereo.model == StereoModel::flat && show.stereo.baseline > 0.0;
}

void plan_flat_shadow(PlanWriter& plan);

//! The shadow that each eye of the stereo model `flat` sees.
inline constexpr PassKind flat_shadow_kind = {"flat_shadow", PassStage::frame, eyes_are_flat, plan_flat_shadow};

}  // namespace ergodome
