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

//! Half axes of the ellipse that is the image of a circle: the direction of the major one, and both
//! lengths.
template <class T>
struct Ellipse {
  Vector3<T> major;
  T major_length;
  T minor_length;
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
  return {(T(1.0F) / sqrt(maximum(length2, tiny))) * axis, sqrt(largest), sqrt(smallest)};
}

//! A line of round probes that approximates an ellipse.
template <class T>
struct ProbeLine {
  T count;
  T spacing;  //!< angle on the sky between neighboring probes [rad]
  T level;    //!< level of the mip pyramid that the probes read
};

//! Computes the probes of an ellipse. A mip level that is read bilinearly is approximately a round
//! Gaussian with a standard deviation of half a texel; the line adds the additional variance σ² of
//! the major axis. Probes have the weights exp(-3.12 x²), where x reaches 1 half a spacing past the
//! last probe. A spacing of 5.2 σ / (number of probes) then yields that variance; for two probes
//! the spacing is 4 σ / 2.
template <class T>
ERGO_HD ProbeLine<T> probe_line(const CubeMap& map, const Ellipse<T>& ellipse) {
  const T one(1.0F);
  const T texel(cube_texel_angle(map));
  const T radius = maximum(ellipse.minor_length, texel * 0.5F);
  const T line = safe_sqrt(ellipse.major_length * ellipse.major_length - radius * radius);
  const T part = line / radius;
  // Probes are at most a texel of their level apart, so that bilinear look-ups of equal weight add
  // up evenly.
  const T wanted = real_of<T>(truncated(minimum(part, T(1e3F)) * 2.6F)) + one;
  const T several = minimum(wanted, T(static_cast<float>(probe_limit)));
  const T count = select(part <= T(0.45F), one, select(part <= one, T(2.0F), several));
  const T spacing = select(count > T(2.0F), T(5.2F), select(count > one, T(4.0F), T(0.0F))) * line / count;
  const T width = maximum(radius, spacing * 0.5F);
  const T level = rough_log2(maximum(width * 2.0F / texel, one));
  return {count, spacing, minimum(maximum(level, T(0.0F)), T(static_cast<float>(map.level_count - 1)))};
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

template <class T>
ERGO_HD LevelLanes<T> level_lanes(const CubeMap& map, const IntegerOf<T>& level) {
  constexpr int lanes = RealTraits<T>::lane_count;
  std::int32_t levels[lanes];
  std::memcpy(levels, &level, sizeof levels);
  std::int32_t offsets[lanes];
  float sizes[lanes];
  for (int i = 0; i < lanes; ++i) {
    const int below = levels[i] < map.level_count ? levels[i] : map.level_count - 1;
    const int at = below > 0 ? below : 0;
    offsets[i] = static_cast<std::int32_t>(map.level_offset[at]);
    sizes[i] = static_cast<float>(map.face_size >> at);
  }
  LevelLanes<T> of;
  of.size = load_lanes<T>(sizes, 0, lanes);
  std::memcpy(&of.first_texel, offsets, sizeof offsets);
  return of;
}

#if !defined(__CUDACC__)
//! A bilinear look-up at one level for each lane of a SIMD register.
template <class T>
class LaneTexels {
 public:
  LaneTexels(const CubeMap& map, const LevelLanes<T>& level, const CubePosition<T>& position, const T& weight)
      : LaneTexels(map, level, weight, bilinear_position(position, level.size)) {}

  //! Adds the look-up of a lane to a sum.
  void add(QuadBlock& sum, int i) const { weights_.add(sum, i, texels_ + first_[i], texels_ + second_[i]); }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

  LaneTexels(const CubeMap& map, const LevelLanes<T>& level, const T& weight, const BilinearPosition<T>& at)
      : texels_(map.texels), weights_(weights_of(at, weight)) {
    // Numbers of floats.
    const IntegerOf<T> first = (level.first_texel + at.texel) * 4;
    const IntegerOf<T> second = first + (truncated(level.size) + 2) * 4;
    std::memcpy(first_, &first, sizeof first_);
    std::memcpy(second_, &second, sizeof second_);
    // Without this, the compiler extracts each number from its register, which takes longer than
    // loading it.
    asm("" : "+m"(first_), "+m"(second_));
  }

  static LaneWeights<T> weights_of(const BilinearPosition<T>& at, const T& weight) {
    const T lower = weight * at.lower;
    const T upper = weight - lower;
    const T upper_right = upper * at.right;
    const T lower_right = lower * at.right;
    return {upper - upper_right, upper_right, lower - lower_right, lower_right};
  }

  const float* texels_;
  LaneWeights<T> weights_;
  std::uint32_t first_[lanes];   //!< upper left texel; its right neighbor follows
  std::uint32_t second_[lanes];  //!< lower left texel
};
#endif

//! Sums of texels for each lane.
template <class T>
class TexelSums {
 public:
  ERGO_HD TexelSums() {
    for (Sum& sum : sums_) {
      clear(sum);
    }
  }

  //! Adds a bilinear look-up for each lane whose weight is positive.
  ERGO_HD void add(const CubeMap& map, const LevelLanes<T>& level, const CubePosition<T>& position, const T& weight) {
    if constexpr (lanes == 1) {
      if (weight > 0.0F) {
        add_one(map, level, position, weight);
      }
    } else {
#if !defined(__CUDACC__)
      const LaneTexels<T> texels(map, level, position, weight);
      add_lanes(mask_bits(weight > T(0.0F)), [&](Sum& sum, int i) { texels.add(sum, i); });
#endif
    }
  }

  //! Adds bilinear look-ups at two levels; `coarse_part` is the weight of the second, for a sum of
  //! `weight`.
  ERGO_HD void add(const CubeMap& map, const LevelLanes<T>& fine, const LevelLanes<T>& coarse, const T& coarse_part,
                   const CubePosition<T>& position, const T& weight) {
    const T coarse_weight = weight * coarse_part;
    if constexpr (lanes == 1) {
      add(map, fine, position, weight - coarse_weight);
      add(map, coarse, position, coarse_weight);
    } else {
#if !defined(__CUDACC__)
      const LaneTexels<T> first(map, fine, position, weight - coarse_weight);
      const LaneTexels<T> second(map, coarse, position, coarse_weight);
      add_lanes(mask_bits(weight > T(0.0F)), [&](Sum& sum, int i) {
        Sum both = sum;
        first.add(both, i);
        second.add(both, i);
        sum = both;
      });
#endif
    }
  }

  //! Returns the sum of a lane.
  [[nodiscard]] ERGO_HD Quad of([[maybe_unused]] int i) const {
    if constexpr (lanes == 1) {
      return sums_[0];
    } else {
#if !defined(__CUDACC__)
      return total(sums_[i]);
#endif
    }
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;
#if defined(__CUDACC__)
  using Sum = Quad;
#else
  using Sum = std::conditional_t<lanes == 1, Quad, QuadBlock>;
  static void clear(QuadBlock& sum) { sum = zero_block(); }
#endif
  static ERGO_HD void clear(Quad& sum) { sum = quad_of(0.0F); }

  ERGO_HD void add_one(const CubeMap& map, const LevelLanes<T>& level, const CubePosition<T>& position,
                       const T& weight) {
    const BilinearPosition<T> at = bilinear_position(position, level.size);
    const T lower = weight * at.lower;
    const T upper = weight - lower;
    const float* const top = map.texels + 4L * (level.first_texel + at.texel);
    const float* const bottom = top + 4L * (truncated(level.size) + 2);
    const Quad left_pair = upper * load_quad(top) + lower * load_quad(bottom);
    const Quad right_pair = upper * load_quad(top + 4) + lower * load_quad(bottom + 4);
    sums_[0] = sums_[0] + (1.0F - at.right) * left_pair + at.right * right_pair;
  }

  //! Calls add(sum, i) for the lanes in a bit mask.
  template <class Add>
  void add_lanes(unsigned some, const Add& add) {
    constexpr unsigned all = (1U << static_cast<unsigned>(lanes)) - 1U;
    if (some == all) {
      ERGO_UNROLL
      for (int i = 0; i < lanes; ++i) {
        add(sums_[i], i);
      }
      return;
    }
    for (unsigned left = some; left != 0; left &= left - 1) {
      const int i = lowest_bit(left);
      add(sums_[i], i);
    }
  }

  Sum sums_[lanes];
};

//! Sums the probes of a line, with weights that sum to `factor`. Lanes with factor 0 use no probes.
template <class T>
ERGO_HD void add_line(const CubeMap& map, const ProbeLine<T>& line, const Vector3<T>& direction,
                      const Vector3<T>& along, const T& factor, SkyLight<T>& sum) {
  const T zero(0.0F);
  const T one(1.0F);
  const IntegerOf<T> fine_level = truncated(line.level);
  const T coarse_part = line.level - real_of<T>(fine_level);
  const bool blended = any((factor > zero) & (coarse_part > zero));
  const LevelLanes<T> fine = level_lanes<T>(map, fine_level);
  const LevelLanes<T> coarse = blended ? level_lanes<T>(map, fine_level + 1) : fine;
  TexelSums<T> texels;
  const T count = select(factor > zero, line.count, zero);
  const T per_count = one / line.count;
  const T half_length = line.count * line.spacing * 0.5F;
  T weights = zero;
  for (T k = zero; any(k < count); k = k + one) {
    const T x = (k * 2.0F + one) * per_count - one;
    T sine;
    T cosine;
    sine_cosine_octant(x * half_length, sine, cosine);
    const CubePosition<T> position = cube_position(cosine * direction + sine * along);
    const T weight = select(k < count, probe_weight(x), zero);
    weights = weights + weight;
    if (blended) {
      texels.add(map, fine, coarse, coarse_part, position, weight);
    } else {
      texels.add(map, fine, position, weight);
    }
  }
  const T scale = factor / maximum(weights, T(1e-37F));
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    sum.pixel[i] = lane(scale, i) * texels.of(i);
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
  const auto resolved = ellipse.major_length < T(1.0F);
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
  const T seen = select(known, factor, zero);
  if (any(seen > zero)) {
    const Vector3<T> towards = {select(known, direction.x, T(1.0F)), direction.y, direction.z};
    detail::TexelSums<T> texels;
    texels.add(map, detail::level_lanes<T>(map, truncated(zero)), cube_position(towards), seen);
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      light.pixel[i] = texels.of(i);
    }
  }
  detail::add_mean(map, select(known, zero, factor), light);
  return light;
}

}  // namespace ergodome::inline ERGO_TARGET
