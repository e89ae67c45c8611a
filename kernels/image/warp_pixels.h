#pragma once

#include <cstdint>

#include "kernels/image/light_levels.h"

namespace ergodome {

//! Neighbouring pixels of a projector's row that are kept together.
inline constexpr int warp_group_px = 16;

//! Steps between two levels of light in which pixels choose.
inline constexpr int warp_level_steps = 32;

//! Where a group's pixels look: pixel i at x + step_x * WarpBatch::x[i], in texels of the finest level, the first texel's middle at 0.
struct WarpGroup {
  float x;
  float y;
  float step_x;
  float step_y;
  std::uint16_t levels;   //!< bit l: pixels that look at level l and, where they are larger, at the next
  std::uint16_t blended;  //!< those of them where some are larger; no levels: the group shows nothing of the master
};

//! A projector's raster, to be filled with what it is sent of a master's light: projector_light.h's formula for each pixel.
//!
//! What a pixel takes is kept as small as eight bits allow, because memory is what a warp waits for: 8 bytes a pixel where masks are grey.
//! Factors of the light (blend, warp's intensity, gain and what the lift leaves) and what the lift adds are the squares of these numbers,
//! times a scale: fine next to black, where the projector's curve is steep.
struct WarpBatch {
  LightLevels light;
  std::int32_t width_px;
  std::int32_t height_px;
  const WarpGroup* groups;  //!< row after row, the last of each row partly beyond it
  const std::uint16_t* x;   //!< warp_group_px for each group, like the following
  const std::uint16_t* y;
  const std::uint8_t* level;  //!< in warp_level_steps from one to the next
  const std::uint16_t*
      factor;  //!< one a pixel; where `coloured` is set red, green, blue of a group, then its red, green, blue lifts
  bool coloured;
  float factor_scale[3];  //!< of a channel, times the square of the number
  float lift_scale[3];    //!< the same of the lift; where `coloured` is not set the lift itself
  float exponent;         //!< of the projector's curve: value = light ^ exponent
  float least;  //!< light below this is black: 2^-100, or the root of it that `exponent` is, where that is more than 1
  std::uint8_t* rgb;  //!< three bytes a pixel, the top row first
};

inline namespace ERGO_TARGET {
//! Groups of a row of pixels.
constexpr int warp_groups(int width_px) { return (width_px + warp_group_px - 1) / warp_group_px; }
}  // namespace ERGO_TARGET

}  // namespace ergodome
