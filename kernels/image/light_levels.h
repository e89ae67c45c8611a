#pragma once

#include <cstdint>

#include "kernels/image/tone_curve.h"
#include "kernels/launch/kernel.h"

// The light of a picture for projectors, in mip levels that are computed tile by tile.
namespace ergodome {

//! Maximum number of levels. No usable warp averages over more than 2^5 pixels.
inline constexpr int max_light_levels = 6;

//! Side of the tiles in which light is computed on demand [texels].
inline constexpr int light_tile_px = 64;
inline constexpr int light_tile_texels = light_tile_px * light_tile_px;

//! A picture's light for projectors, or its averages: linear, 0 to 1, four floats per texel, top
//! row first. One texel beyond the end can be read.
struct LightLevel {
  float* rgba;
  std::int32_t width;
  std::int32_t height;
};

//! Light and its averages: each level has half the width and height of the one before, rounded
//! down.
struct LightLevels {
  LightLevel level[max_light_levels];
  std::int32_t count;
};

//! Applies the tone curve to tiles of a picture (of `to`'s size, four floats per pixel). Tiles are
//! numbered row by row.
struct ToneBatch {
  const float* from;
  LightLevel to;
  Tone tone;
  bool as_it_is;  //!< the picture is already display light, which is only clamped to [0, 1]
  const std::int32_t* tiles;
  int count;
};

//! Computes tiles of a mip level from the next finer level.
struct AverageBatch {
  LightLevel from;
  LightLevel to;
  const std::int32_t* tiles;
  int count;
};

inline namespace ERGO_TARGET {
//! Returns the number of tiles along one side of a picture.
constexpr int light_tiles(int size) { return (size + light_tile_px - 1) / light_tile_px; }
}  // namespace ERGO_TARGET

template <>
struct Kernel<ToneBatch> : KernelDefaults {
  static constexpr bool one_element_a_call = true;
  static constexpr int grain = grid_grain;
  static const char* name(const ToneBatch& /*batch*/) { return "tone_tiles"; }
  static int elements(const ToneBatch& batch) { return batch.count; }
};

template <>
struct Kernel<AverageBatch> : KernelDefaults {
  static constexpr bool one_element_a_call = true;
  static constexpr int grain = grid_grain;
  static const char* name(const AverageBatch& /*batch*/) { return "average_tiles"; }
  static int elements(const AverageBatch& batch) { return batch.count; }
};

}  // namespace ergodome
