#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! Returns whether a show's pictures have images or texts over them.
inline bool has_overlays(const Show& show, ViewMode mode) {
  const Timeline& timeline = show.timeline;
  return mode == ViewMode::sky && (!timeline.overlays.empty() || !timeline.captions.empty() || show.readout);
}

//! Adds the work for overlays to the plan. Images are read for all view modes; which overlays are
//! drawn depends on the time.
void plan_overlays(PlanWriter& plan);

//! Returns a pass for every show, because captions can also come from outside the show.
std::unique_ptr<Pass> make_overlay_pass(const PassInput& input);

//! The pass that draws captions and images over pictures.
inline constexpr PassKind overlay_kind = {"overlays", PassStage::frame, has_overlays, plan_overlays, make_overlay_pass};

}  // namespace ergodome
