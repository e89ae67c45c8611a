#include "app/budget/budget_check.h"

#include <random>

#include "app/budget/lens_error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/accuracy/statistics.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/sky/sky_shading.h"

namespace ergodome {

BudgetCheck check_error(ShowRenderer& renderer, const Show& show, const FrameQuality& quality, int size_px, int moments,
                        std::uint64_t seed, int rows) {
  std::mt19937_64 random(seed);
  renderer.set_quality(quality);
  std::vector<double> errors_px;
  BudgetCheck check;
  for (int i = 0; i < moments; ++i) {
    const double time_s = show.duration_s * static_cast<double>(random() >> 11U) * 0x1p-53;
    renderer.apply(time_s);
    const CameraPose pose = camera_pose(show, time_s);
    const Projection projection = make_projection(renderer.show().view, size_px > 0 ? size_px : show.view.size_px, 0.0);
    const LensErrors exact(eye_camera(renderer.show(), pose, 0.0), projection,
                           row_samples(projection, rows, rows, random()), pixel_angle(projection));
    const bool footprints = lens_channels(ViewMode::sky, shading_of(renderer.show())).footprint;
    const auto lens = renderer.lens_of(pose, projection, {time_s});
    const std::vector<double> all =
        exact.errors(renderer.backend(), *lens, footprints ? PixelNeed::footprint : PixelNeed::sky);
    errors_px.push_back(summary_of(all).p99);
    if (errors_px.back() >= check.worst_px) {
      check.worst_px = errors_px.back();
      check.worst_time_s = time_s;
    }
  }
  check.moments = moments;
  check.median_px = spread_of(errors_px).median;
  return check;
}

}  // namespace ergodome
