#include "kernels/image/shade_pixels_kernel.h"
#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/overlay/draw_overlay_kernel.h"
#include "kernels/stars/draw_stars_kernel.h"

// The ways to shade pixels, in a file of their own: they are many.
namespace ergodome {

void shade_pixels_cuda(const ShadeBatch& batch) {
  if (batch.mode != ViewMode::sky) {
    return launch_cuda("shade_pixels", batch.count, ShadeHeatMap{batch});
  }
  dispatch_shading<float>(batch, [&](const auto& functor) { launch_cuda("shade_pixels", batch.count, functor); });
}

void draw_stars_cuda(const StarLightBatch& batch) { launch_cuda("draw_stars", batch.count, DrawStars{batch}); }

void draw_overlay_cuda(const OverlayBatch& batch) {
  launch_cuda("draw_overlay", batch.count, DrawOverlay<float>{batch});
}

}  // namespace ergodome
