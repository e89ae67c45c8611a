#pragma once

#include "kernels/image/shade_pixels.h"
#include "kernels/lens/tile_look_up.h"

// Batches of pixels that are read from lens grids on tiles of the screen, and shaded tile by tile.
namespace ergodome {

//! The pixels of a look-up on tiles, which are shaded at once: the channels of a tile never leave the
//! nearest cache, and texels of the sky map are read for many neighboring pixels in turn.
//!
//! The channels of `lens` state which are needed, and are not written; those of `shading` are not
//! read.
struct TileShadeBatch {
  TileLookUpBatch lens;
  ShadeBatch shading;
};

//! Returns whether tiles can be shaded with the options of a batch.
constexpr bool shades_on_tiles(ViewMode mode, SkyFilter filter, bool brightening) {
  return mode == ViewMode::sky && filter != SkyFilter::polygon && !brightening;
}

//! Returns the work counter's name for shading on tiles.
constexpr const char* tile_shading_name(SkyFilter filter, SkyShift shift) {
  constexpr const char* names[2][3] = {
      {"shade_tiles", "shade_tiles, luminance", "shade_tiles, blackbody_fit"},
      {"shade_tiles, point", "shade_tiles, point, luminance", "shade_tiles, point, blackbody_fit"}};
  return names[filter == SkyFilter::ewa ? 0 : 1][static_cast<int>(shift)];
}

template <>
struct Kernel<TileShadeBatch> : KernelDefaults {
  static constexpr bool one_element_a_call = true;
  static constexpr int grain = 4;
  static const char* name(const TileShadeBatch& batch) {
    return tile_shading_name(batch.shading.filter, batch.shading.shift);
  }
  static int elements(const TileShadeBatch& batch) { return element_count(batch.lens); }
  static long work(const TileShadeBatch& batch) { return counted_elements(batch.lens); }

  template <class Visit>
  static void visit_outputs(const TileShadeBatch& batch, const Visit& visit) {
    Kernel<ShadeBatch>::visit_outputs(batch.shading, visit);
  }
};

}  // namespace ergodome
