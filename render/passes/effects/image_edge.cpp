#include "render/passes/effects/image_edge.h"

namespace ergodome {

void plan_image_edge(PlanWriter& plan) {
  const ViewMode mode = plan.request().mode;
  if (spreads_beyond_image(plan.most(), mode)) {
    plan.picture_pass("clear_outside",
                      plan.why(needs_bloom(plan.most(), mode) ? "effects.bloom" : "effects.diffraction"),
                      !spreads_beyond_image(plan.least(), mode));
  }
}

}  // namespace ergodome
