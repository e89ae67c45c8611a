#pragma once

#include <cstdint>

#include "kernels/image/light_levels.h"
#include "kernels/launch/kernel.h"

// Warping of a master's light to a projector's raster.
namespace ergodome {

//! Number of adjacent pixels in a projector's row that are processed together.
inline constexpr int warp_group_px = 16;

//! Steps between two levels of light, from which pixels choose.
inline constexpr int warp_level_steps = 32;

//! Positions that a group's pixels sample: pixel i at x + step_x * WarpBatch::x[i], in texels of
//! the finest level, with the center of the first texel at 0.
struct WarpGroup {
  float x;
  float y;
  float step_x;
  float step_y;
  //! Bit l: some pixels sample level l and, if they are larger, the next one. 0 if the group shows
  //! nothing of the master.
  std::uint16_t levels;
  std::uint16_t blended;  //!< bit l: some of these pixels also sample the next level
};

//! A projector's raster, filled with the values that it is sent for a master's light: the formula
//! of projector_light.h for each pixel.
//!
//! Memory limits the speed of a warp, so the data of a pixel is as small as eight bits of output
//! allow: 8 bytes per pixel if masks are gray. Factors of the light (blend, the warp's intensity,
//! gain, and the rest that the lift leaves) and the lift itself are stored as square roots times a
//! scale. Their steps are then fine near black, where the projector's curve is steep.
struct WarpBatch {
  LightLevels light;
  std::int32_t width_px;
  std::int32_t height_px;
  const WarpGroup* groups;  //!< row by row, the last of each row partly beyond it
  const std::uint16_t* x;   //!< warp_group_px for each group, like the following
  const std::uint16_t* y;
  const std::uint8_t* level;  //!< in warp_level_steps from one level to the next
  //! One per pixel. If `coloured`, a group's red, green and blue factors, then its red, green and
  //! blue lifts.
  const std::uint16_t* factor;
  bool coloured;
  float factor_scale[3];  //!< factor of the square of the number, per channel
  float lift_scale[3];    //!< the same for the lift; if not `coloured`, the lift itself
  float exponent;         //!< of the projector's curve: value = light ^ exponent
  //! Light is raised to at least this, which is still black: 2^-100, or 2^(-100 / exponent) if the
  //! exponent is above 1.
  float least;
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
  //! Groups of pixels.
  static int elements(const WarpBatch& batch) { return warp_groups(batch.width_px) * batch.height_px; }
  static long work(const WarpBatch& batch) { return static_cast<long>(batch.width_px) * batch.height_px; }
};

}  // namespace ergodome
