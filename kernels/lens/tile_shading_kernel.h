#pragma once

#include "kernels/image/shade_pixels_kernel.h"
#include "kernels/lens/tile_look_up_kernel.h"
#include "kernels/lens/tile_shading.h"

// Shades pixels on tiles of the screen, on the CPU.
namespace ergodome::inline ERGO_TARGET {

//! Reads and shades the pixels of a batch; each index is a tile.
template <class T, SkyFilter Filter, SkyShift Shift>
struct ShadeTiles {
  static constexpr bool footprints = Filter == SkyFilter::ewa;
  LookUpTiles<T, footprints> lens;
  ShadeSky<T, Filter, Shift, false> shading;

  explicit ShadeTiles(const TileShadeBatch& batch) : lens{batch.lens}, shading{batch.shading} {}

  void operator()(int index) const {
    const PixelBatch& pixels = lens.batch.look_up.pixels;
    const int x = lens.left_of(index);
    const int y = lens.top_of(index);
    const int begin = std::max(y, pixels.first_row);
    const int end = std::min(y + tile_side, pixels.first_row + pixels.row_count);
    const int width = std::min(tile_side, pixels.projection.width_px - x);
    alignas(64) float memory[channels][tile_pixels];
    if (width < tile_side) {
      // Pixels beyond the right side of the image are shaded, but not stored.
      std::memset(memory, 0, sizeof memory);
    }
    const LensPixels of_tile = lens_pixels(memory);
    const bool lit = lens.fill(index, {of_tile, x, y, tile_side, true});
    for (int row = begin; row < end; ++row) {
      float* const to =
          shading.batch.rgba + 4 * (static_cast<long>(row - pixels.first_row) * pixels.projection.width_px + x);
      if (!lit) {
        std::memset(to, 0, static_cast<std::size_t>(width) * 4 * sizeof(float));
        continue;
      }
      for (int column = 0; column < width; column += RealTraits<T>::lane_count) {
        shading.shade(of_tile, (row - y) * tile_side + column, tile_pixels, to + 4 * column, width - column);
      }
    }
  }

 private:
  static constexpr int tile_pixels = tile_side * tile_side;
  static constexpr int channels = 4 + (footprints ? 6 : 0) + (Shift != SkyShift::none ? 1 : 0);

  //! Returns the channels that shading reads, in `memory`.
  static LensPixels lens_pixels(float (&memory)[channels][tile_pixels]) {
    LensPixels of{};
    int next = 0;
    of.coverage = memory[next++];
    for (int axis = 0; axis < 3; ++axis) {
      of.sky[axis] = memory[next++];
      if constexpr (footprints) {
        of.sky_along_x[axis] = memory[next++];
        of.sky_along_y[axis] = memory[next++];
      }
    }
    if constexpr (Shift != SkyShift::none) {
      of.frequency_ratio = memory[next++];
    }
    return of;
  }
};

namespace detail {
template <class T, SkyFilter Filter, class Action>
void dispatch_tile_shift(const TileShadeBatch& batch, const Action& action) {
  switch (batch.shading.shift) {
    case SkyShift::none:
      return action(ShadeTiles<T, Filter, SkyShift::none>{batch});
    case SkyShift::luminance:
      return action(ShadeTiles<T, Filter, SkyShift::luminance>{batch});
    case SkyShift::blackbody_fit:
      return action(ShadeTiles<T, Filter, SkyShift::blackbody_fit>{batch});
  }
}
}  // namespace detail

template <class T, class Action>
void dispatch(const TileShadeBatch& batch, const Action& action) {
  if (batch.shading.filter == SkyFilter::ewa) {
    return detail::dispatch_tile_shift<T, SkyFilter::ewa>(batch, action);
  }
  return detail::dispatch_tile_shift<T, SkyFilter::point>(batch, action);
}

}  // namespace ergodome::inline ERGO_TARGET
