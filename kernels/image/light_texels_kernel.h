#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/quad.h"
#include "kernels/image/light_levels.h"

// Light levels one texel at a time, for devices with their many threads.
// kernels/image/light_levels_kernel.h computes the same levels on the CPU, tile by tile.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
//! Two adjacent texels of a finer level, and the position between them.
struct FinerPosition {
  int first;
  int second;
  float part;
};

//! Returns the position of the center of texel `at` of `size` in the finer level.
ERGO_HD FinerPosition finer_position(int at, int size, int finer_size) {
  const float exact =
      (static_cast<float>(at) + 0.5F) * (static_cast<float>(finer_size) / static_cast<float>(size)) - 0.5F;
  const int first = static_cast<int>(exact);
  const int second = first + 1 < finer_size ? first + 1 : first;
  return {first, second, exact - static_cast<float>(first)};
}

//! Interpolates between two texels of a row.
ERGO_HD Quad between(const float* row, const FinerPosition& x) {
  return (1.0F - x.part) * load_quad(row + 4 * x.first) + x.part * load_quad(row + 4 * x.second);
}

//! Position of a texel in a level.
struct LevelPosition {
  int column;
  int row;
};

//! Returns the texel of an index. Every listed tile has light_tile_texels indices; where a tile
//! extends beyond the level, the texel is outside the level.
ERGO_HD LevelPosition position_in_tiles(const LightLevel& level, const std::int32_t* tiles, int index) {
  const int tile = tiles[index / light_tile_texels];
  const int texel = index % light_tile_texels;
  const int across = light_tiles(level.width);
  const int row = tile / across;
  return {(tile - row * across) * light_tile_px + texel % light_tile_px, row * light_tile_px + texel / light_tile_px};
}

ERGO_HD bool is_within(const LightLevel& level, const LevelPosition& at) {
  return at.column < level.width && at.row < level.height;
}

ERGO_HD long first_float(const LightLevel& level, const LevelPosition& at) {
  return 4 * (static_cast<long>(at.row) * level.width + at.column);
}
}  // namespace detail

//! Applies the tone curve. Each index is one texel, and every listed tile has light_tile_texels
//! indices. The fourth component, coverage, is not changed, as projectors do not use it.
struct ToneTexels {
  ToneBatch batch;

  ERGO_HD void operator()(int index) const {
    const detail::LevelPosition at = detail::position_in_tiles(batch.to, batch.tiles, index);
    if (!detail::is_within(batch.to, at)) {
      return;
    }
    const long first = detail::first_float(batch.to, at);
    const Quad seen = load_quad(batch.from + first);
    store_quad(batch.to.rgba + first, quad_from(shown(quad_part(seen, 0)), shown(quad_part(seen, 1)),
                                                shown(quad_part(seen, 2)), quad_part(seen, 3)));
  }

 private:
  ERGO_HD float shown(float light) const {
    const float display = batch.as_it_is ? ::fmaxf(light, 0.0F) : toned(batch.tone, light);
    return ::fminf(display, 1.0F);
  }
};

//! Averages a level. Each index is one texel, and every listed tile has light_tile_texels indices.
struct AverageTexels {
  AverageBatch batch;

  ERGO_HD void operator()(int index) const {
    const detail::LevelPosition at = detail::position_in_tiles(batch.to, batch.tiles, index);
    if (!detail::is_within(batch.to, at)) {
      return;
    }
    const detail::FinerPosition x = detail::finer_position(at.column, batch.to.width, batch.from.width);
    const detail::FinerPosition y = detail::finer_position(at.row, batch.to.height, batch.from.height);
    const float* const upper = batch.from.rgba + detail::first_float(batch.from, {0, y.first});
    const float* const lower = batch.from.rgba + detail::first_float(batch.from, {0, y.second});
    store_quad(batch.to.rgba + detail::first_float(batch.to, at),
               (1.0F - y.part) * detail::between(upper, x) + y.part * detail::between(lower, x));
  }
};

}  // namespace ergodome::inline ERGO_TARGET
