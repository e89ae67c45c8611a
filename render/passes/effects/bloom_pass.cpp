#include "render/passes/effects/bloom_pass.h"

#include "render/passes/effects/bloom_across_seams.h"
#include "render/passes/effects/picture_effect.h"

namespace ergodome {

void plan_bloom(PlanWriter& plan) {
  const ViewMode mode = plan.request().mode;
  if (needs_bloom(plan.maximum(), mode)) {
    plan.picture_pass("add_bloom", plan.why("effects.bloom"), !needs_bloom(plan.minimum(), mode));
  }
}

std::unique_ptr<Pass> make_bloom_pass(const PassInput& input) {
  const auto add = [](Picture& picture, const EyePicture& wanted) {
    add_bloom(picture, wanted.projection, *wanted.settings.show->effects.bloom);
  };
  return input.show.effects.bloom ? std::make_unique<PictureEffect>(bloom_kind, add) : nullptr;
}

}  // namespace ergodome
