#include "render/passes/overlay/overlay_kind.h"

namespace ergodome {

void plan_overlays(PlanWriter& plan) {
  const Show& show = plan.maximum();
  const Timeline& timeline = show.timeline;
  if (!timeline.overlays.empty()) {
    plan.buffer("overlay images", WorkMoment::start, plan.request().overlay_bytes, plan.why("overlay"));
  }
  if (!has_overlays(show, plan.request().mode)) {
    return;
  }
  std::string of_words = timeline.captions.empty() ? "" : plan.why("caption");
  of_words += show.readout ? (of_words.empty() ? "" : ", ") + plan.why("readout") : "";
  if (!of_words.empty()) {
    plan.pass("set_captions", WorkMoment::start, 0, 0, of_words, true);
    plan.buffer("captions", WorkMoment::start, 0, of_words);
  }
  std::string shown = timeline.overlays.empty() ? "" : plan.why("overlay");
  shown += of_words.empty() ? "" : (shown.empty() ? "" : ", ") + of_words;
  plan.pass("draw_overlay", WorkMoment::picture, 0, 0, shown, true);
}

}  // namespace ergodome
