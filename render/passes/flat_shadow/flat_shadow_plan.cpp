#include "render/passes/flat_shadow/flat_shadow_kind.h"

namespace ergodome {

void plan_flat_shadow(PlanWriter& plan) {
  if (share_camera(plan.most().stereo)) {
    const bool at_times = plan.eyes_are_together_at_times();
    plan.pass("trace_affine_distances", WorkMoment::picture, 1, 0, plan.why("stereo.model"), at_times);
    plan.picture_pass("mask_shadow", plan.why("stereo.baseline"), at_times);
  }
}

}  // namespace ergodome
