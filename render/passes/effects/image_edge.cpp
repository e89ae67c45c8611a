#include "render/passes/effects/image_edge.h"

#include <algorithm>

#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/effects/picture_effect.h"

namespace ergodome {

namespace {

void clear_outside(Picture& picture, const EyePicture& wanted) {
  const Projection& projection = wanted.projection;
  static WorkCounter counter("clear_outside");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  parallel_for(picture.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (!(image_coverage(projection, x + 0.5, y + 0.5) > 0.0)) {
          const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
          std::fill_n(picture.rgba.begin() + static_cast<long>(4 * (at + static_cast<std::size_t>(x))), 3, 0.0F);
        }
      }
    }
  });
}

}  // namespace

void plan_image_edge(PlanWriter& plan) {
  const ViewMode mode = plan.request().mode;
  if (spreads_beyond_image(plan.maximum(), mode)) {
    plan.picture_pass("clear_outside",
                      plan.why(needs_bloom(plan.maximum(), mode) ? "effects.bloom" : "effects.diffraction"),
                      !spreads_beyond_image(plan.minimum(), mode));
  }
}

std::unique_ptr<Pass> make_image_edge_pass(const PassInput& input) {
  const EffectSettings& effects = input.show.effects;
  return effects.bloom || effects.diffraction ? std::make_unique<PictureEffect>(image_edge_kind, clear_outside)
                                              : nullptr;
}

}  // namespace ergodome
