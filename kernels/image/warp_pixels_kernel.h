#pragma once

#include <cstring>

#include "kernels/core/lanes.h"
#include "kernels/core/quad.h"
#include "kernels/image/byte_power.h"
#include "kernels/image/warp_pixels.h"

// Warps groups of pixels on the CPU. Devices warp one pixel at a time
// (kernels/image/warp_pixel_kernel.h), and OpenGL uses texture units
// (render/present/projectors/projector_drawing.h).
namespace ergodome::inline ERGO_TARGET {

namespace detail {
//! Two adjacent texels.
struct QuadPair {
  using Register __attribute__((vector_size(32))) = float;
  Register part;
};

inline QuadPair::Register load_quad_pair(const float* from) {
  QuadPair::Register pair;
  std::memcpy(&pair, from, sizeof pair);
  return pair;
}

//! Loads integers of an array as numbers, one in each lane.
template <class T, class Whole>
inline T load_whole(const Whole* from) {
  constexpr int lanes = RealTraits<T>::lane_count;
  using Narrow __attribute__((vector_size(lanes * sizeof(Whole)))) = Whole;
  Narrow narrow;
  std::memcpy(&narrow, from, sizeof narrow);
  return real_of<T>(__builtin_convertvector(narrow, IntegerOf<T>));
}

//! Returns round(255 a^p) in the lowest byte of each lane, the other bytes undefined, for the same
//! a and p as the scalar version.
template <int N>
inline typename PackMask<float, N>::Register eight_bit_power(const Pack<float, N>& a, float p) {
  using T = Pack<float, N>;
  using Integer = typename PackMask<float, N>::Register;
  using Register = typename T::Register;
  const Integer bits = (Integer)a.lanes - root_of_half_bits;
  const T e(__builtin_convertvector(bits >> 23, Register));
  const T t = T((Register)((bits & mantissa_bits) + root_of_half_bits)) - 1.0F;
  const T power = binary_logarithm(t, e) * p;
  // After adding 1.5 * 2^23, the lowest bits contain the nearest integer, which becomes the
  // exponent of a float.
  constexpr float magic = 12582912.0F;
  const T whole = round_to_nearest(power);
  const Integer exponent = (Integer)(whole + magic).lanes << 23;
  const T value((Register)((Integer)scaled_power_of_two(T(power - whole)).lanes + exponent));
  return (Integer)(value + magic).lanes;
}

//! interleave() writes the bytes of three channels of 16 pixels to `to`, pixel by pixel: r g b r g
//! b ...
using Bytes16 __attribute__((vector_size(16))) = std::uint8_t;
inline void interleave(const Bytes16& r, const Bytes16& g, const Bytes16& b, std::uint8_t* to) {
  // Shuffles two operands at a time: indices from 16 on select from the second operand, and zeros
  // are placeholders for the bytes of the third channel.
  const Bytes16 rg0 = __builtin_shufflevector(r, g, 0, 16, 0, 1, 17, 0, 2, 18, 0, 3, 19, 0, 4, 20, 0, 5);
  const Bytes16 rg1 = __builtin_shufflevector(r, g, 21, 0, 6, 22, 0, 7, 23, 0, 8, 24, 0, 9, 25, 0, 10, 26);
  const Bytes16 rg2 = __builtin_shufflevector(r, g, 0, 11, 27, 0, 12, 28, 0, 13, 29, 0, 14, 30, 0, 15, 31, 0);
  const Bytes16 all0 = __builtin_shufflevector(rg0, b, 0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15);
  const Bytes16 all1 = __builtin_shufflevector(rg1, b, 0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15);
  const Bytes16 all2 = __builtin_shufflevector(rg2, b, 26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31);
  std::memcpy(to, &all0, 16);
  std::memcpy(to + 16, &all1, 16);
  std::memcpy(to + 32, &all2, 16);
}
}  // namespace detail

//! Warps group i of the pixels of the projector's raster. `T` is a pack of floats.
template <class T, bool Coloured>
struct WarpPixels {
  WarpBatch batch;

  void operator()(int index) const {
    const WarpGroup& group = batch.groups[index];
    const int row = index / warp_groups(batch.width_px);
    const int column = (index - row * warp_groups(batch.width_px)) * warp_group_px;
    const int inside = batch.width_px - column < warp_group_px ? batch.width_px - column : warp_group_px;
    Quad light[warp_group_px];
    if (group.levels == 0 || (group.levels & (group.levels - 1)) != 0) {
      std::memset(light, 0, sizeof light);
    }
    for (unsigned levels = group.levels; levels != 0; levels &= levels - 1) {
      seen_at(index, __builtin_ctz(levels), light);
    }
    Channels channels;
    take_apart(light, channels);
    send(index, channels, batch.rgb + 3 * (static_cast<long>(row) * batch.width_px + column), inside);
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;
  static_assert(warp_group_px % lanes == 0);

  //! For each pixel of a group: the upper left of the four texels around its position, and the
  //! position between them as fractions.
  struct TexelPositions {
    alignas(64) std::int32_t texel[warp_group_px];
    alignas(64) float across[warp_group_px];
    alignas(64) float down[warp_group_px];
  };

  //! Red, green and blue of a group's pixels.
  struct Channels {
    alignas(64) float part[3][warp_group_px];
  };

  //! Returns the first of the two of `size` texels around a position; `part` receives the fraction
  //! between them.
  static T first_of_two(const T& position, int size, T& part) {
    const T within = minimum(maximum(position, T(0.0F)), T(static_cast<float>(size - 1)));
    const T first = real_of<T>(truncated(minimum(within, T(static_cast<float>(size > 1 ? size - 2 : 0)))));
    part = within - first;
    return first;
  }

  void find(int index, const LightLevel& level, TexelPositions& positions) const {
    const WarpGroup& group = batch.groups[index];
    const LightLevel& finest = batch.light.level[0];
    const float scale_x = static_cast<float>(level.width) / static_cast<float>(finest.width);
    const float scale_y = static_cast<float>(level.height) / static_cast<float>(finest.height);
    for (int i = 0; i < warp_group_px; i += lanes) {
      const int at = warp_group_px * index + i;
      const T x = detail::load_whole<T>(batch.x + at) * group.step_x + group.x;
      const T y = detail::load_whole<T>(batch.y + at) * group.step_y + group.y;
      T across;
      T down;
      const auto column = truncated(first_of_two((x + 0.5F) * scale_x - 0.5F, level.width, across));
      const auto line = truncated(first_of_two((y + 0.5F) * scale_y - 0.5F, level.height, down));
      const IntegerOf<T> texel = line * level.width + column;
      std::memcpy(positions.texel + i, &texel, sizeof texel);
      std::memcpy(positions.across + i, &across, sizeof across);
      std::memcpy(positions.down + i, &down, sizeof down);
    }
  }

  //! Interpolates light between four texels.
  static Quad light_at(const LightLevel& level, const TexelPositions& positions, int i) {
    const float* const upper = level.rgba + 4 * static_cast<long>(positions.texel[i]);
    const float* const lower = level.height > 1 ? upper + 4 * static_cast<long>(level.width) : upper;
    const auto above = detail::load_quad_pair(upper);
    const auto middle = above + positions.down[i] * (detail::load_quad_pair(lower) - above);
    Quad left;
    Quad right;
    std::memcpy(&left, &middle, sizeof left);
    std::memcpy(&right, reinterpret_cast<const char*>(&middle) + sizeof left, sizeof right);
    return {left.part + positions.across[i] * (right.part - left.part)};
  }

  //! Computes the light of the group's pixels that sample mip level `finer`, blended with the next
  //! coarser level as their `level` requires. Leaves the other pixels unchanged.
  void seen_at(int index, int finer, Quad* light) const {
    const LightLevel& level = batch.light.level[finer];
    const bool alone = (batch.groups[index].levels & (batch.groups[index].levels - 1)) == 0;
    const std::uint8_t* const chosen = batch.level + warp_group_px * static_cast<long>(index);
    TexelPositions positions;
    find(index, level, positions);
    if (alone && batch.groups[index].blended == 0) {
      for (int i = 0; i < warp_group_px; ++i) {
        light[i] = light_at(level, positions, i);
      }
      return;
    }
    const LightLevel& next = batch.light.level[finer + 1 < batch.light.count ? finer + 1 : finer];
    TexelPositions wider;
    find(index, next, wider);
    for (int i = 0; i < warp_group_px; ++i) {
      if (!alone && chosen[i] / warp_level_steps != finer) {
        continue;
      }
      const float part = static_cast<float>(chosen[i] % warp_level_steps) * (1.0F / warp_level_steps);
      const Quad fine = light_at(level, positions, i);
      const Quad coarse = light_at(next, wider, i);
      light[i] = {fine.part + part * (coarse.part - fine.part)};
    }
  }

  static void take_apart(const Quad* light, Channels& to) {
    for (int i = 0; i < warp_group_px; i += 4) {
      const Quad::Register a = light[i].part;
      const Quad::Register b = light[i + 1].part;
      const Quad::Register c = light[i + 2].part;
      const Quad::Register d = light[i + 3].part;
      const Quad::Register ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
      const Quad::Register cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
      const Quad::Register ab_blue = __builtin_shufflevector(a, b, 2, 6, 2, 6);
      const Quad::Register cd_blue = __builtin_shufflevector(c, d, 2, 6, 2, 6);
      store_quad(&to.part[0][i], {__builtin_shufflevector(ab, cd, 0, 1, 4, 5)});
      store_quad(&to.part[1][i], {__builtin_shufflevector(ab, cd, 2, 3, 6, 7)});
      store_quad(&to.part[2][i], {__builtin_shufflevector(ab_blue, cd_blue, 0, 1, 4, 5)});
    }
  }

  static T square_of(const std::uint16_t* root) {
    const T number = detail::load_whole<T>(root);
    return number * number;
  }

  //! Applies blending, lift and the projector's curve to light, and writes the bytes to send.
  void send(int index, const Channels& light, std::uint8_t* rgb, int count) const {
    using Bytes __attribute__((vector_size(lanes))) = std::uint8_t;
    const std::uint16_t* const factor = batch.factor + (Coloured ? 6 : 1) * warp_group_px * static_cast<long>(index);
    detail::Bytes16 bytes[3];
    for (int channel = 0; channel < 3; ++channel) {
      for (int i = 0; i < warp_group_px; i += lanes) {
        T shown;
        std::memcpy(&shown, light.part[channel] + i, sizeof shown);
        T sent;
        if constexpr (Coloured) {
          const std::uint16_t* const own = factor + channel * warp_group_px + i;
          sent = shown * square_of(own) * batch.factor_scale[channel] +
                 square_of(own + 3 * warp_group_px) * batch.lift_scale[channel];
        } else {
          sent = shown * square_of(factor + i) * batch.factor_scale[channel] + batch.lift_scale[channel];
        }
        const T value = minimum(maximum(sent, T(batch.minimum)), T(1.0F));
        const Bytes narrow = __builtin_convertvector(detail::eight_bit_power(value, batch.exponent), Bytes);
        std::memcpy(reinterpret_cast<char*>(&bytes[channel]) + i, &narrow, sizeof narrow);
      }
    }
    if (count == warp_group_px) {
      return detail::interleave(bytes[0], bytes[1], bytes[2], rgb);
    }
    std::uint8_t last[3 * warp_group_px];
    detail::interleave(bytes[0], bytes[1], bytes[2], last);
    std::memcpy(rgb, last, 3 * static_cast<std::size_t>(count));
  }
};

template <class T, class Action>
void dispatch(const WarpBatch& batch, const Action& action) {
  if (batch.coloured) {
    action(WarpPixels<T, true>{batch});
  } else {
    action(WarpPixels<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
