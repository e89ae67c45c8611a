#include "render/passes/effects/vignette.h"

#include <algorithm>
#include <cmath>

#include "content/show/animated_show.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/projection.h"
#include "render/passes/effects/picture_effect.h"

namespace ergodome {

namespace {

void draw_vignette(Picture& picture, const EyePicture& wanted) {
  static WorkCounter counter("draw_vignette");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  const double strength = wanted.settings.show->view.vignette;
  parallel_for(picture.height, 16, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      float* pixel = picture.rgba.data() + 4 * static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width);
      for (int column = 0; column < picture.width; ++column, pixel += 4) {
        double x = 0.0;
        double y = 0.0;
        image_position(wanted.projection, column + 0.5, row + 0.5, x, y);
        const auto light = static_cast<float>(vignette_light(strength, std::hypot(x, y)));
        std::for_each(pixel, pixel + 3, [&](float& value) { value *= light; });
      }
    }
  });
}

}  // namespace

double vignette_light(double strength, double distance) {
  const double t = std::clamp(2.0 * distance - 1.0, 0.0, 1.0);
  return 1.0 - strength * t * t * (3.0 - 2.0 * t);
}

void plan_vignette(PlanWriter& plan) {
  const ViewMode mode = plan.request().mode;
  if (needs_vignette(plan.maximum(), mode)) {
    plan.picture_pass("draw_vignette", plan.why("view.vignette"), !needs_vignette(plan.minimum(), mode));
  }
}

std::unique_ptr<Pass> make_vignette_pass(const PassInput& input) {
  return needs_vignette(show_at_most(input.show), ViewMode::sky)
             ? std::make_unique<PictureEffect>(vignette_kind, draw_vignette)
             : nullptr;
}

}  // namespace ergodome
