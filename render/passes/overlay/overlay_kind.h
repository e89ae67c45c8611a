#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! Returns whether a show has images or words over its pictures.
inline bool has_overlays(const Show& show, ViewMode mode) {
  const Timeline& timeline = show.timeline;
  return mode == ViewMode::sky && (!timeline.overlays.empty() || !timeline.captions.empty() || show.readout);
}

//! Adds the work for overlays to the plan. Images are read for all view modes; which overlays are
//! drawn depends on the time.
void plan_overlays(PlanWriter& plan);

//! Captions and images over pictures.
inline constexpr PassKind overlay_kind = {"overlays", PassStage::frame, has_overlays, plan_overlays};

}  // namespace ergodome
