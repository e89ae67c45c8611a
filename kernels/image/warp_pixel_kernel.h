#pragma once

#include "kernels/core/quad.h"
#include "kernels/image/byte_power.h"
#include "kernels/image/warp_pixels.h"

// Warps one pixel at a time, for devices with their many threads. WarpPixels computes the same on
// the CPU, by groups of pixels.
namespace ergodome::inline ERGO_TARGET {

//! Warps one pixel of the projector's raster; index i counts the pixels row by row.
template <bool Coloured>
struct WarpPixel {
  WarpBatch batch;

  ERGO_HD void operator()(int index) const {
    const int y = index / batch.width_px;
    store(index, sent(index - y * batch.width_px, y));
  }

  //! Returns the value of a pixel as sent to the projector: red in the lowest byte, then green and
  //! blue.
  ERGO_HD std::uint32_t sent(int x, int y) const {
    const int group = y * warp_groups(batch.width_px) + x / warp_group_px;
    const int position = x % warp_group_px;
    const Quad light = light_of(group, position);
    std::uint32_t rgb = 0;
    ERGO_UNROLL
    for (int channel = 0; channel < 3; ++channel) {
      rgb |= value_of(group, position, channel, quad_part(light, channel)) << (8U * static_cast<unsigned>(channel));
    }
    return rgb;
  }

  //! Writes the three bytes of a pixel.
  ERGO_HD void store(long pixel, std::uint32_t rgb) const {
    std::uint8_t* const to = batch.rgb + 3 * pixel;
    to[0] = static_cast<std::uint8_t>(rgb);
    to[1] = static_cast<std::uint8_t>(rgb >> 8U);
    to[2] = static_cast<std::uint8_t>(rgb >> 16U);
  }

 private:
  //! Returns the first of the two of `size` texels around a position; `part` receives the fraction
  //! between them.
  ERGO_HD static int first_of_two(float position, int size, float& part) {
    const float within = ::fminf(::fmaxf(position, 0.0F), static_cast<float>(size - 1));
    const int last_pair = size > 1 ? size - 2 : 0;
    const int whole = static_cast<int>(within);
    const int first = whole < last_pair ? whole : last_pair;
    part = within - static_cast<float>(first);
    return first;
  }

  //! Returns the light of a level at a position of the finest level.
  ERGO_HD Quad light_at(const LightLevel& level, float x, float y) const {
    const LightLevel& finest = batch.light.level[0];
    const float scale_x = static_cast<float>(level.width) / static_cast<float>(finest.width);
    const float scale_y = static_cast<float>(level.height) / static_cast<float>(finest.height);
    float across = 0.0F;
    float down = 0.0F;
    const int column = first_of_two((x + 0.5F) * scale_x - 0.5F, level.width, across);
    const int line = first_of_two((y + 0.5F) * scale_y - 0.5F, level.height, down);
    const float* const upper = level.rgba + 4 * (static_cast<long>(line) * level.width + column);
    const float* const lower = level.height > 1 ? upper + 4 * static_cast<long>(level.width) : upper;
    return between(between(load_quad(upper), load_quad(lower), down),
                   between(load_quad(upper + 4), load_quad(lower + 4), down), across);
  }

  ERGO_HD static Quad between(const Quad& a, const Quad& b, float part) { return (1.0F - part) * a + part * b; }

  ERGO_HD Quad light_of(int group_number, int position) const {
    const WarpGroup& group = batch.groups[group_number];
    if (group.levels == 0) {
      return quad_of(0.0F);
    }
    const long at = static_cast<long>(warp_group_px) * group_number + position;
    const float x = static_cast<float>(batch.x[at]) * group.step_x + group.x;
    const float y = static_cast<float>(batch.y[at]) * group.step_y + group.y;
    const int chosen = batch.level[at];
    const int finer = chosen / warp_level_steps;
    const int steps = chosen % warp_level_steps;
    const Quad fine = light_at(batch.light.level[finer], x, y);
    if (steps == 0) {
      return fine;
    }
    const int next = finer + 1 < batch.light.count ? finer + 1 : finer;
    return between(fine, light_at(batch.light.level[next], x, y),
                   static_cast<float>(steps) * (1.0F / warp_level_steps));
  }

  ERGO_HD static float square_of(std::uint16_t root) { return static_cast<float>(root) * static_cast<float>(root); }

  //! Returns the byte to send for a channel: applies blending, lift and the projector's curve to
  //! its light.
  ERGO_HD std::uint32_t value_of(int group, int position, int channel, float light) const {
    constexpr int kinds = Coloured ? 6 : 1;
    const std::uint16_t* const factor = batch.factor + static_cast<long>(warp_group_px * kinds) * group + position;
    float sent = 0.0F;
    if constexpr (Coloured) {
      sent = light * square_of(factor[channel * warp_group_px]) * batch.factor_scale[channel] +
             square_of(factor[(channel + 3) * warp_group_px]) * batch.lift_scale[channel];
    } else {
      sent = light * square_of(*factor) * batch.factor_scale[channel] + batch.lift_scale[channel];
    }
    return detail::eight_bit_power(::fminf(::fmaxf(sent, batch.minimum), 1.0F), batch.exponent);
  }
};

}  // namespace ergodome::inline ERGO_TARGET
