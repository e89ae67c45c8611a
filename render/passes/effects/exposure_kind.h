#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

inline bool needs_auto_exposure(const Show& show, ViewMode mode) {
  return mode == ViewMode::sky && show.tone.automatic.has_value();
}

//! Adapts the exposure to the light of finished pictures.
inline constexpr PassKind exposure_kind = {"exposure",
                                           PassStage::frame,
                                           needs_auto_exposure,
                                           [](PlanWriter& plan) {
                                             if (needs_auto_exposure(plan.most(), plan.request().mode)) {
                                               plan.picture_pass("meter_light", plan.why("tone.auto"));
                                             }
                                           },
                                           nullptr,
                                           /*serves_one_picture=*/false,
                                           /*in_host_memory=*/true};

}  // namespace ergodome
