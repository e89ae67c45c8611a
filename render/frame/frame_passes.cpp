#include "render/frame/frame_passes.h"

#include <array>

#include "render/passes/effects/bloom_pass.h"
#include "render/passes/effects/exposure_pass.h"
#include "render/passes/effects/image_edge.h"
#include "render/passes/effects/vignette.h"
#include "render/passes/flat_shadow/flat_shadow_pass.h"
#include "render/passes/near_field/near_field_kind.h"
#include "render/passes/objects/object_kind.h"
#include "render/passes/overlay/overlay_kind.h"
#include "render/passes/sky/sky_kind.h"
#include "render/passes/stars/star_kind.h"
#include "render/plan/plan_writer.h"

namespace ergodome {

std::span<const PassKind> frame_passes() {
  static constexpr std::array kinds = {sky_kind,   star_kind,       flat_shadow_kind, near_field_kind, polygon_kind,
                                       bloom_kind, image_edge_kind, vignette_kind,    exposure_kind,   overlay_kind};
  return kinds;
}

FramePlan plan_frame(const Show& show, const FrameRequest& request) {
  PlanWriter plan(show, request, frame_passes());
  for (const PassKind& kind : frame_passes()) {
    kind.plan(plan);
  }
  return plan.finish();
}

}  // namespace ergodome
