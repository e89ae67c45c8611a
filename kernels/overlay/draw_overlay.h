#pragma once

#include <cstdint>

#include "kernels/image/tone_curve.h"
#include "kernels/overlay/overlay_sheet.h"
#include "kernels/overlay/overlay_texture.h"
#include "kernels/projection/projection.h"

namespace ergodome {

//! Side of the squares that pictures are divided into where overlays are drawn [px].
inline constexpr int overlay_tile_px = 32;

//! An overlay to draw over a picture, on those of its tiles that it may touch. Arrays lie in the backend's memory.
//!
//! What is shown is covered by it, not the light: the picture's light is brought to the display's by its tone, covered, and brought back. So an
//! overlay's colours do not depend on the exposure. Where it is drawn, light has no more than what shows as white.
struct OverlayBatch {
  float* rgba;  //!< of the whole picture: light and coverage
  ProjectionOf<float> projection;
  OverlayTexture texture;
  OverlaySheet sheet;
  float opacity;
  Tone tone;
  bool display_colours;       //!< the picture's light is a display's: no tone comes on it
  const std::int32_t* tiles;  //!< numbers of tiles, row by row from the top left
  int tile_columns;           //!< of the picture
  int count;                  //!< pixels of the tiles
};

}  // namespace ergodome
