#pragma once

#include <cstdint>

#include "kernels/image/tone_curve.h"

namespace ergodome {

//! Averages over more than 2^5 pixels are not wanted by any warp that makes a picture.
inline constexpr int most_light_levels = 6;

//! Side of the tiles [texels] in which light is made where it is wanted.
inline constexpr int light_tile_px = 64;
inline constexpr int light_tile_texels = light_tile_px * light_tile_px;

//! A picture's light for projectors, or its averages: linear, 0 to 1, four floats a texel, the top row first. One texel more than the
//! picture has can be read behind its end.
struct LightLevel {
  float* rgba;
  std::int32_t width;
  std::int32_t height;
};

//! Light and its averages: each level is half as wide and high as the one before, rounded down.
struct LightLevels {
  LightLevel level[most_light_levels];
  std::int32_t count;
};

//! Makes light of tiles of a picture (of `to`'s size, four floats a pixel) by its tone. Tiles are numbered row after row.
struct ToneBatch {
  const float* from;
  LightLevel to;
  Tone tone;
  bool as_it_is;  //!< the picture is display light already
  const std::int32_t* tiles;
  int count;
};

//! Makes tiles of a level from the one before.
struct AverageBatch {
  LightLevel from;
  LightLevel to;
  const std::int32_t* tiles;
  int count;
};

inline namespace ERGO_TARGET {
//! How many tiles lie side by side in a picture.
constexpr int light_tiles(int size) { return (size + light_tile_px - 1) / light_tile_px; }
}  // namespace ERGO_TARGET

}  // namespace ergodome
