#pragma once

#include <cstdint>

#include "kernels/image/light_levels.h"
#include "kernels/launch/kernel.h"

// Warps the light of a domemaster (the "master") to the raster of a projector.
namespace ergodome {

//! Number of adjacent pixels in a projector's row that are processed together.
inline constexpr int warp_group_px = 16;

//! Number of steps between adjacent mip levels of the light. The level that a pixel samples is
//! rounded to such a step.
inline constexpr int warp_level_steps = 32;

//! Positions that a group's pixels sample: pixel i at x + step_x * WarpBatch::x[i], in texels of
//! the finest level, with the center of the first texel at 0.
struct WarpGroup {
  float x;
  float y;
  float step_x;
  float step_y;
  //! Bit l is set if some pixels of the group sample mip level l. Pixels that are larger than its
  //! texels also sample level l + 1. 0 if the group shows nothing of the master.
  std::uint16_t levels;
  //! Bit l is set if some of the pixels that sample level l also sample level l + 1.
  std::uint16_t blended;
};

//! Computes the values to send to a projector, for all pixels of its raster, from the light of a
//! master. The formula for a pixel is that of projector_light.h.
//!
//! Memory limits the speed of a warp, so the data of a pixel is as small as eight bits of output
//! allow: 8 bytes per pixel if masks are gray. Factors of the light (blend, the warp's intensity,
//! gain, and the rest that the lift leaves) and the lift itself are stored as square roots times a
//! scale. Their steps are then fine near black, where the projector's curve is steep.
struct WarpBatch {
  LightLevels light;
  std::int32_t width_px;
  std::int32_t height_px;
  const WarpGroup* groups;  //!< row by row; the last group of a row may extend beyond the row
  //! Each pixel's x (see WarpGroup). `x`, `y` and `level` have warp_group_px elements per group.
  const std::uint16_t* x;
  const std::uint16_t* y;
  const std::uint8_t* level;  //!< mip level of each pixel, in units of 1 / warp_level_steps
  //! Stored number of the light's factor (see factor_scale), one per pixel. If `coloured`, each
  //! group has its red, green and blue factors, then its red, green and blue lifts.
  const std::uint16_t* factor;
  bool coloured;
  float factor_scale[3];  //!< per channel: factor of the light = factor_scale * (stored number)²
  float lift_scale[3];    //!< lift = lift_scale * (stored number)²; if not `coloured`, the lift itself
  float exponent;         //!< exponent of the projector's curve: value = light ^ exponent
  //! Minimum light: smaller values are replaced by this one, which is still black. It is 2^-100, or
  //! 2^(-100 / exponent) if the exponent is above 1.
  float minimum;
  std::uint8_t* rgb;  //!< three bytes per pixel, top row first
};

inline namespace ERGO_TARGET {
//! Returns the number of groups in a row of pixels.
constexpr int warp_groups(int width_px) { return (width_px + warp_group_px - 1) / warp_group_px; }
}  // namespace ERGO_TARGET

template <>
struct Kernel<WarpBatch> : KernelDefaults {
  static constexpr bool one_element_a_call = true;
  static constexpr int grain = 512;
  static const char* name(const WarpBatch& /*batch*/) { return "warp_pixels"; }
  //! Returns the number of groups of pixels.
  static int elements(const WarpBatch& batch) { return warp_groups(batch.width_px) * batch.height_px; }
  static long work(const WarpBatch& batch) { return static_cast<long>(batch.width_px) * batch.height_px; }
};

}  // namespace ergodome
