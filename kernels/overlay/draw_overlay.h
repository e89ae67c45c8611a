#pragma once

#include <cstdint>

#include "kernels/image/tone_curve.h"
#include "kernels/launch/kernel.h"
#include "kernels/overlay/overlay_surface.h"
#include "kernels/overlay/overlay_texture.h"
#include "kernels/projection/projection.h"

// The batch that draws an overlay over a picture.
namespace ergodome {

//! Side of the square tiles into which pictures are divided for drawing overlays [px].
inline constexpr int overlay_tile_px = 32;

//! An overlay to draw over a picture, on those tiles of the picture that the overlay may touch.
//! Arrays lie in the backend's memory.
//!
//! The overlay covers displayed values, not light: the picture's light is converted to display
//! values by its tone, covered, and converted back. So an overlay's colors do not depend on the
//! exposure. Where the overlay is drawn, light is limited to what displays as white.
struct OverlayBatch {
  float* rgba;  //!< light and coverage of the whole picture
  ProjectionOf<float> projection;
  OverlayTexture texture;
  OverlaySurface surface;
  float opacity;
  Tone tone;
  bool display_colours;       //!< the picture has a display's values already: no tone is applied
  const std::int32_t* tiles;  //!< indices of tiles, which count row by row from the top left
  int tile_columns;           //!< tiles per row of the picture
  int count;                  //!< number of pixels of the listed tiles
};

template <>
struct Kernel<OverlayBatch> : KernelDefaults {
  static const char* name(const OverlayBatch& /*batch*/) { return "draw_overlay"; }
  static int elements(const OverlayBatch& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const OverlayBatch& batch, const Visit& visit) {
    visit("rgba", batch.rgba, 4L * batch.projection.width_px * batch.projection.height_px);
  }
};

}  // namespace ergodome
