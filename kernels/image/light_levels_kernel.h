#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/transcendental.h"
#include "kernels/image/light_texels_kernel.h"

// Computes a picture's light for projectors, and its averages at half the size, a quarter, and so
// on. Each index is one tile.
namespace ergodome::inline ERGO_TARGET {

//! Returns a^p for a >= 0 and p > 0, to a few units in the last place times the size of the
//! exponent; at least e^-80 = 2e-35, also for a = 0.
template <int N>
inline Pack<float, N> power(const Pack<float, N>& a, float p) {
  const Pack<float, N> logarithm = natural_logarithm(maximum(a, Pack<float, N>(1e-37F)));
  return exponential(maximum(logarithm * p, Pack<float, N>(-80.0F)));
}

//! Applies the formulas of kernels/image/tone_curve.h to each lane; NaN becomes black.
template <int N>
inline Pack<float, N> toned(const Tone& tone, const Pack<float, N>& light) {
  using T = Pack<float, N>;
  const T x = maximum(light * tone.gain, T(0.0F));
  switch (tone.curve) {
    case ToneCurve::reinhard:
      return select(x < T(1e18F), x * (x * (1.0F / (tone.white * tone.white)) + 1.0F) / (x + 1.0F), T(1.0F));
    case ToneCurve::filmic:
      return select(x < T(1e4F), x * (x * 2.51F + 0.03F) / (x * (x * 2.43F + 0.59F) + 0.14F), T(1.0F));
    case ToneCurve::gamma:
      return power(x, 1.0F / tone.gamma);
    case ToneCurve::shoulder:
      break;
  }
  const auto bent = x > T(tone_knee);
  if (!any(bent)) {
    return x;
  }
  const T over = minimum((x - tone_knee) * (1.0F / (1.0F - tone_knee)), T(80.0F));
  return select(bent, T(1.0F) - exponential(-over) * (1.0F - tone_knee), x);
}

namespace detail {
//! Columns [left, right) and rows [top, bottom) of a tile, as far as they are inside the level.
struct TileBounds {
  int left;
  int right;
  int top;
  int bottom;
};

ERGO_HD TileBounds tile_bounds(const LightLevel& level, std::int32_t tile) {
  const int across = light_tiles(level.width);
  const int left = tile % across * light_tile_px;
  const int top = tile / across * light_tile_px;
  const int right = left + light_tile_px;
  const int bottom = top + light_tile_px;
  return {left, right < level.width ? right : level.width, top, bottom < level.height ? bottom : level.height};
}
}  // namespace detail

//! Applies the tone curve to all four floats of each texel; index i is a tile. Projectors do not
//! use the fourth one, the coverage.
template <class T>
struct ToneTiles {
  ToneBatch batch;

  ERGO_HD void operator()(int index) const {
    const detail::TileBounds tile = detail::tile_bounds(batch.to, batch.tiles[index]);
    const int count = 4 * (tile.right - tile.left);
    for (int row = tile.top; row < tile.bottom; ++row) {
      const long first = 4 * (static_cast<long>(row) * batch.to.width + tile.left);
      for (int i = 0; i < count; i += RealTraits<T>::lane_count) {
        const T light = load_lanes<T>(batch.from + first, i, count);
        const T shown = batch.as_it_is ? maximum(light, T(0.0F)) : toned(batch.tone, light);
        store_lanes(batch.to.rgba + first, i, count, minimum(shown, T(1.0F)));
      }
    }
  }
};

//! Averages a level; index i is a tile. A texel is the finer level interpolated at its center,
//! between the four nearest texels. If width and height of the finer level are even, that is the
//! mean of four texels.
struct AverageTiles {
  AverageBatch batch;

  ERGO_HD void operator()(int index) const {
    const detail::TileBounds tile = detail::tile_bounds(batch.to, batch.tiles[index]);
    for (int row = tile.top; row < tile.bottom; ++row) {
      const detail::FinerPosition y = detail::finer_position(row, batch.to.height, batch.from.height);
      const float* const upper = batch.from.rgba + 4 * (static_cast<long>(y.first) * batch.from.width);
      const float* const lower = batch.from.rgba + 4 * (static_cast<long>(y.second) * batch.from.width);
      float* const to = batch.to.rgba + 4 * (static_cast<long>(row) * batch.to.width);
      for (int column = tile.left; column < tile.right; ++column) {
        const detail::FinerPosition x = detail::finer_position(column, batch.to.width, batch.from.width);
        store_quad(to + 4 * column, (1.0F - y.part) * detail::between(upper, x) + y.part * detail::between(lower, x));
      }
    }
  }
};

template <class T, class Action>
void dispatch(const ToneBatch& batch, const Action& action) {
  action(ToneTiles<T>{batch});
}

template <class T, class Action>
void dispatch(const AverageBatch& batch, const Action& action) {
  action(AverageTiles{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
