#pragma once

#include "kernels/core/lanes.h"
#include "kernels/sky/cube_map.h"
#if !defined(__CUDACC__)
#include "kernels/core/quad_block.h"
#endif

// Filters of the sky's cube map: anisotropic, or bilinear in a single direction.
namespace ergodome::inline ERGO_TARGET {

//! Maximum number of probes along the major axis. Ellipses that need more get wider probes.
inline constexpr int probe_limit = 16;

//! Light of as many pixels as a real number has lanes, with the components of texels.
template <class T>
struct SkyLight {
  Quad pixel[RealTraits<T>::lane_count];
};

namespace detail {

template <class T>
ERGO_HD SkyLight<T> no_light() {
  SkyLight<T> light;
  for (Quad& pixel : light.pixel) {
    pixel = quad_of(0.0F);
  }
  return light;
}

//! Adds the mean of the sky, times the share of each lane, to the lanes.
template <class T>
ERGO_HD void add_mean(const CubeMap& map, const T& share, SkyLight<T>& light) {
  if (any(share > T(0.0F))) {
    const Quad mean = cube_mean_texel(map);
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      light.pixel[i] = light.pixel[i] + lane(share, i) * mean;
    }
  }
}

//! The ellipse that is the image of a circle: the direction of its major half axis, and the squares of both half axes.
template <class T>
struct Ellipse {
  Vector3<T> major;
  T major_square;
  T minor_square;
};

//! Returns the ellipse of the map (cos t, sin t) -> cos t a + sin t b, from the eigenvalues of its
//! 2 x 2 Gram matrix.
template <class T>
ERGO_HD Ellipse<T> ellipse_of(const Vector3<T>& a, const Vector3<T>& b) {
  const T zero(0.0F);
  const T tiny(1e-37F);
  const T aa = dot(a, a);
  const T bb = dot(b, b);
  const T ab = dot(a, b);
  const T half_sum = (aa + bb) * 0.5F;
  const T half_difference = (aa - bb) * 0.5F;
  const T root = sqrt(half_difference * half_difference + ab * ab);
  const T largest = half_sum + root;
  // The product of the eigenvalues is |a x b|²: no cancellation for thin ellipses.
  const Vector3<T> area = cross(a, b);
  const T smallest = dot(area, area) / maximum(largest, tiny);
  const auto along_a = half_difference >= zero;
  const T of_a = select(along_a, half_difference + root, ab);
  const T of_b = select(along_a, ab, root - half_difference);
  const Vector3<T> axis = of_a * a + of_b * b;
  const T length2 = dot(axis, axis);
  // A circle has no major axis; any direction works, because its probes coincide.
  return {(T(1.0F) / sqrt(maximum(length2, tiny))) * axis, largest, smallest};
}

//! A line of round probes that approximates an ellipse.
template <class T>
struct ProbeLine {
  T count;
  T per_count;    //!< 1 / count
  T half_length;  //!< angle on the sky from its middle to half a spacing past the last probe [rad]
  T level;        //!< level of the mip pyramid that the probes read
};

//! Computes the probes of an ellipse. A mip level that is read bilinearly is approximately a round
//! Gaussian with a standard deviation of half a texel; the line adds the additional variance σ² of
//! the major axis. Probes have the weights exp(-3.12 x²), where x reaches 1 half a spacing past the
//! last probe. A half length of 2.6 σ then yields that variance; for two probes it is 2 σ.
template <class T>
ERGO_HD ProbeLine<T> probe_line(const CubeMap& map, const Ellipse<T>& ellipse) {
  const T zero(0.0F);
  const T one(1.0F);
  const float texel = cube_texel_angle(map);
  const T radius_square = maximum(ellipse.minor_square, T(0.25F * texel * texel));
  const T radius = sqrt(radius_square);
  const T line = safe_sqrt(ellipse.major_square - radius_square);
  const T part = line / radius;
  // Probes are at most a texel of their level apart, so that bilinear look-ups of equal weight add
  // up evenly.
  const T wanted = real_of<T>(truncated(minimum(part, T(1e3F)) * 2.6F)) + one;
  const T several = minimum(wanted, T(static_cast<float>(probe_limit)));
  const T count = select(part <= T(0.45F), one, select(part <= one, T(2.0F), several));
  const T per_count = one / count;
  const T half_length = select(count > T(2.0F), T(2.6F), select(count > one, T(2.0F), zero)) * line;
  const T width = maximum(radius, half_length * per_count);
  const T level = rough_log2(maximum(width * (2.0F / texel), one));
  return {count, per_count, half_length, minimum(maximum(level, zero), T(static_cast<float>(map.level_count - 1)))};
}

//! Approximates exp(-3.12 x²) for x in [-1, 1] by the eighth power of a quartic.
template <class T>
ERGO_HD T probe_weight(const T& x) {
  const T y = x * x * -0.39F;
  const T e = y * (y * (y * (y * 0.041666667F + 0.16666667F) + 0.5F) + 1.0F) + 1.0F;
  const T e2 = e * e;
  const T e4 = e2 * e2;
  return e4 * e4;
}

//! One level of the pyramid for each lane.
template <class T>
struct LevelLanes {
  T size;                    //!< width of a face
  IntegerOf<T> first_texel;  //!< number of the level's first texel
};

//! Returns the number of the nearest existing level.
ERGO_HD int limited_level(const CubeMap& map, int level) {
  return level < 0 ? 0 : level < map.level_count ? level : map.level_count - 1;
}

//! level_lanes() for lanes that read different levels.
template <class T>
ERGO_HD_RARE LevelLanes<T> different_levels(const CubeMap& map, const IntegerOf<T>& level) {
  constexpr int lanes = RealTraits<T>::lane_count;
  std::int32_t levels[lanes];
  std::memcpy(levels, &level, sizeof levels);
  std::int32_t offsets[lanes];
  float sizes[lanes];
  for (int i = 0; i < lanes; ++i) {
    const int at = limited_level(map, levels[i]);
    offsets[i] = static_cast<std::int32_t>(map.level_offset[at]);
    sizes[i] = static_cast<float>(map.face_size >> at);
  }
  LevelLanes<T> of;
  of.size = load_lanes<T>(sizes, 0, lanes);
  std::memcpy(&of.first_texel, offsets, sizeof offsets);
  return of;
}

//! Returns the level that each lane reads, given its number. In most registers, all lanes read the same level.
template <class T>
ERGO_HD LevelLanes<T> level_lanes(const CubeMap& map, const IntegerOf<T>& level) {
  std::int32_t first = 0;
  std::memcpy(&first, &level, sizeof first);
  if constexpr (RealTraits<T>::lane_count > 1) {
    if (any(absolute(real_of<T>(level) - static_cast<float>(first)) > T(0.5F))) {
      return different_levels<T>(map, level);
    }
  }
  const int at = limited_level(map, first);
  return {T(static_cast<float>(map.face_size >> at)), IntegerOf<T>{} + static_cast<std::int32_t>(map.level_offset[at])};
}

//! Adds a bilinear look-up at one level to a sum.
ERGO_HD void add_look_up(const CubeMap& map, const LevelLanes<float>& level, const CubePosition<float>& position,
                         float weight, Quad& sum) {
  const BilinearPosition<float> at = bilinear_position(position, level.size);
  const float lower = weight * at.lower;
  const float upper = weight - lower;
  const HalfQuad* const top = map.texels + (level.first_texel + at.texel);
  const HalfQuad* const bottom = top + (truncated(level.size) + 2);
  const Quad left_pair = upper * load_quad(top) + lower * load_quad(bottom);
  const Quad right_pair = upper * load_quad(top + 1) + lower * load_quad(bottom + 1);
  sum = sum + (1.0F - at.right) * left_pair + at.right * right_pair;
}

#if !defined(__CUDACC__)
//! Bilinear look-ups at one level, up to `Limit` for each lane of a SIMD register. They are stored first, and added
//! lane by lane, so that the sum of a lane stays in a register.
template <class T, int Limit>
class StoredLookUps {
 public:
  StoredLookUps(const CubeMap& map, const LevelLanes<T>& level) : texels_(map.texels), level_(level) {
    const IntegerOf<T> row = truncated(level.size) + 2;
    std::memcpy(row_, &row, sizeof row_);
  }

  //! Stores look-up k of each lane, and prefetches its texels.
  [[gnu::always_inline]] void set(int k, const CubePosition<T>& position, const T& weight) {
    const BilinearPosition<T> at = bilinear_position(position, level_.size);
    const T lower = weight * at.lower;
    const T upper = weight - lower;
    const T upper_right = upper * at.right;
    const T lower_right = lower * at.right;
    weights_[k] = LaneWeights<T>(upper - upper_right, upper_right, lower - lower_right, lower_right);
    const IntegerOf<T> first = level_.first_texel + at.texel;
    std::memcpy(first_[k], &first, sizeof first_[k]);
    // A large map does not fit into the nearest caches. Lanes without a look-up may ask for any address, which is
    // harmless.
    ERGO_UNROLL
    for (int i = 0; i < lanes; ++i) {
      const HalfQuad* const texel = texels_ + first_[k][i];
      __builtin_prefetch(texel);
      __builtin_prefetch(texel + row_[i]);
    }
  }

  //! Adds the first `count` look-ups of a lane to a sum.
  void add(QuadBlock& sum, int i, int count) const {
    const HalfQuad* const upper = texels_;
    const HalfQuad* const lower = texels_ + row_[i];
    // Unrolled for each lane, this would be more code than the processor can keep decoded.
#pragma GCC unroll 1
    for (int k = 0; k < count; ++k) {
      const std::uint32_t first = first_[k][i];
      weights_[k].add(sum, i, upper + first, lower + first);
    }
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

  const HalfQuad* texels_;
  LevelLanes<T> level_;
  std::uint32_t row_[lanes];           //!< texels from a texel to its lower neighbor
  std::uint32_t first_[Limit][lanes];  //!< index of the upper left texel; its right neighbor follows
  LaneWeights<T> weights_[Limit];
};
#endif

//! Returns the position of the probe at x, from -1 to 1, of a line: an arc of a great circle through `direction`.
template <class T>
ERGO_HD CubePosition<T> probe_position(const ProbeLine<T>& line, const Vector3<T>& direction, const Vector3<T>& along,
                                       const T& x) {
  T sine;
  T cosine;
  sine_cosine_octant(x * line.half_length, sine, cosine);
  return cube_position(cosine * direction + sine * along);
}

//! Sums the probes of a line, with weights that sum to `factor`. Lanes with factor 0 use no probes.
template <class T>
ERGO_HD void add_line(const CubeMap& map, const ProbeLine<T>& line, const Vector3<T>& direction,
                      const Vector3<T>& along, const T& factor, SkyLight<T>& sum) {
  constexpr int lanes = RealTraits<T>::lane_count;
  const T zero(0.0F);
  const T one(1.0F);
  const IntegerOf<T> fine_level = truncated(line.level);
  const T coarse_part = line.level - real_of<T>(fine_level);
  const bool blended = any((factor > zero) & (coarse_part > zero));
  const LevelLanes<T> fine = level_lanes<T>(map, fine_level);
  const LevelLanes<T> coarse = blended ? level_lanes<T>(map, fine_level + 1) : fine;
  const T count = select(factor > zero, line.count, zero);
  T weights = zero;
  if constexpr (lanes == 1) {
    Quad light = quad_of(0.0F);
    for (float k = 0.0F; k < count; k += 1.0F) {
      const float x = (k * 2.0F + 1.0F) * line.per_count - 1.0F;
      const CubePosition<float> position = probe_position(line, direction, along, x);
      const float weight = probe_weight(x);
      weights += weight;
      add_look_up(map, fine, position, weight * (1.0F - coarse_part), light);
      if (blended) {
        add_look_up(map, coarse, position, weight * coarse_part, light);
      }
    }
    sum.pixel[0] = factor * map.scale / maximum(weights, 1e-37F) * light;
  } else {
#if !defined(__CUDACC__)
    StoredLookUps<T, probe_limit> in_fine(map, fine);
    StoredLookUps<T, probe_limit> in_coarse(map, coarse);
    int stored = 0;
    for (T k = zero; any(k < count); k = k + one) {
      const T x = (k * 2.0F + one) * line.per_count - one;
      const CubePosition<T> position = probe_position(line, direction, along, x);
      const T weight = select(k < count, probe_weight(x), zero);
      weights = weights + weight;
      const T coarse_weight = weight * coarse_part;
      in_fine.set(stored, position, weight - coarse_weight);
      if (blended) {
        in_coarse.set(stored, position, coarse_weight);
      }
      ++stored;
    }
    const T scale = factor * map.scale / maximum(weights, T(1e-37F));
    const IntegerOf<T> whole = truncated(count);
    std::int32_t counts[lanes];
    std::memcpy(counts, &whole, sizeof counts);
    ERGO_UNROLL
    for (int i = 0; i < lanes; i += 4) {
      QuadBlock lights[4];
      ERGO_UNROLL
      for (int j = 0; j < 4; ++j) {
        lights[j] = zero_block();
        in_fine.add(lights[j], i + j, counts[i + j]);
        if (blended) {
          in_coarse.add(lights[j], i + j, counts[i + j]);
        }
      }
      totals(lights, sum.pixel + i);
    }
    for (int i = 0; i < lanes; ++i) {
      sum.pixel[i] = lane(scale, i) * sum.pixel[i];
    }
#endif
  }
}

}  // namespace detail

//! Returns the light of the sky over the footprint of each pixel, times a factor: an elliptic
//! Gaussian, as round probes along its major axis.
//!
//! `direction` is a unit vector, `along_x` and `along_y` are its derivatives per pixel. Where
//! `factor` is 0 they are ignored and the light is 0. The probes are as wide as the minor axis and
//! lie on a great circle, so they cross faces and poles like any other position (after Feline:
//! McCormack, Perry, Farkas & Jouppi, SIGGRAPH 1999; EWA: Heckbert 1989). A footprint with a
//! standard deviation of 1 rad or more, or NaN, sees the mean of the sky. Weights sum to 1, so a
//! constant sky stays constant.
template <class T>
ERGO_HD SkyLight<T> filter_sky(const CubeMap& map, const Vector3<T>& direction, const Vector3<T>& along_x,
                               const Vector3<T>& along_y, const T& factor) {
  const T zero(0.0F);
  // A pixel is a Gaussian with a standard deviation of 0.5 px.
  const detail::Ellipse<T> ellipse = detail::ellipse_of(0.5F * along_x, 0.5F * along_y);
  const auto resolved = ellipse.major_square < T(1.0F);
  SkyLight<T> light = detail::no_light<T>();
  const T seen = select(resolved, factor, zero);
  if (any(seen > zero)) {
    detail::add_line(map, detail::probe_line(map, ellipse), direction, ellipse.major, seen, light);
  }
  detail::add_mean(map, select(resolved, zero, factor), light);
  return light;
}

//! Returns the light of the sky in one direction per pixel, times a factor: bilinear between the
//! finest texels, regardless of the pixel's footprint. Fine stars and lines flicker where the lens
//! shrinks the sky.
//!
//! `direction` is a unit vector; a zero vector sees the mean of the sky.
template <class T>
ERGO_HD SkyLight<T> sample_sky(const CubeMap& map, const Vector3<T>& direction, const T& factor) {
  const T zero(0.0F);
  const auto known = dot(direction, direction) > T(0.5F);
  SkyLight<T> light = detail::no_light<T>();
  const T seen = select(known, factor * map.scale, zero);
  if (any(seen > zero)) {
    const Vector3<T> towards = {select(known, direction.x, T(1.0F)), direction.y, direction.z};
    const CubePosition<T> position = cube_position(towards);
    const detail::LevelLanes<T> level = detail::level_lanes<T>(map, truncated(zero));
    if constexpr (RealTraits<T>::lane_count == 1) {
      detail::add_look_up(map, level, position, seen, light.pixel[0]);
    } else {
#if !defined(__CUDACC__)
      detail::StoredLookUps<T, 1> look_ups(map, level);
      look_ups.set(0, position, seen);
      ERGO_UNROLL
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        QuadBlock sum = zero_block();
        look_ups.add(sum, i, lane(seen, i) > 0.0F ? 1 : 0);
        light.pixel[i] = total(sum);
      }
#endif
    }
  }
  detail::add_mean(map, select(known, zero, factor), light);
  return light;
}

}  // namespace ergodome::inline ERGO_TARGET
