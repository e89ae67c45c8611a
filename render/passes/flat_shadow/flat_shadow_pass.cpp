#include "render/passes/flat_shadow/flat_shadow_pass.h"

#include "render/lens/flat/flat_shadow.h"
#include "render/passes/effects/picture_effect.h"
#include "render/passes/flat_shadow/shadow_mask.h"

namespace ergodome {

void plan_flat_shadow(PlanWriter& plan) {
  if (share_camera(plan.maximum().stereo)) {
    const bool at_times = plan.eyes_are_together_at_times();
    plan.pass("trace_affine_distances", WorkMoment::picture, 1, 0, plan.why("stereo.model"), at_times);
    plan.picture_pass("mask_shadow", plan.why("stereo.baseline"), at_times);
  }
}

std::unique_ptr<Pass> make_flat_shadow_pass(const PassInput& /*input*/) {
  const auto mask = [](Picture& picture, const EyePicture& wanted) {
    if (const std::optional<SharedCameraEye>& eye = wanted.settings.shared) {
      const ShadowChart& chart = eye->shadow->chart();
      mask_shadow(picture, wanted.projection, edge_view(chart, eye->shadow->head_edge()), edge_view(chart, eye->edge));
    }
  };
  return std::make_unique<PictureEffect>(flat_shadow_kind, mask);
}

}  // namespace ergodome
