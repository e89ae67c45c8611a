#include "render/passes/effects/bloom_pass.h"

namespace ergodome {

void plan_bloom(PlanWriter& plan) {
  const ViewMode mode = plan.request().mode;
  if (needs_bloom(plan.most(), mode)) {
    plan.picture_pass("add_bloom", plan.why("effects.bloom"), !needs_bloom(plan.least(), mode));
  }
}

}  // namespace ergodome
