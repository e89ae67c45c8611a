#include "kernels/launch/launch.h"
#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/run_on_cpu.h"
#include "kernels/stars/draw_stars_kernel.h"

namespace ergodome {

void draw_stars(Backend backend, const StarLightBatch& batch, long points) {
  static WorkCounter spots("splat_stars");
  static WorkCounter spikes("draw_spikes");
  const WorkScope work(batch.pattern != nullptr ? spikes : spots, points);
  if (backend == Backend::cuda) {
    return draw_stars_cuda(batch);
  }
  const DrawStars draw{batch};
  parallel_for(batch.count, star_tile_px * star_tile_px, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      draw(i);
    }
  });
}

}  // namespace ergodome
