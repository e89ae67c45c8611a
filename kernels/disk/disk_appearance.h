#pragma once

#include <cstdint>

#include "kernels/core/arithmetic.h"
#include "kernels/disk/disk_emitter.h"
#include "kernels/sky/blackbody.h"

// A disk's appearance as kernels read it: edges, temperature, exposure and pattern.
namespace ergodome {

//! The time at which a pattern is seen. Inner matter overtakes outer matter and would wind up any
//! pattern for ever. So clouds live for one period each, in two sets that alternate.
struct PatternTime {
  float period;         //!< life of a cloud [M]
  float age;            //!< age of the first set's clouds at the camera's time, in [0, period) [M]
  std::uint32_t cycle;  //!< number of periods that have passed
};

inline namespace ERGO_TARGET {

namespace detail {

//! Hashes an integer to a pseudorandom one (Wellons' lowbias32).
ERGO_HD std::uint32_t scrambled(std::uint32_t x) {
  x = (x ^ (x >> 16U)) * 0x7feb352dU;
  x = (x ^ (x >> 15U)) * 0x846ca68bU;
  return x ^ (x >> 16U);
}

//! Returns a pseudorandom value in [-1, 1] at a point of a lattice that repeats after `around`
//! columns.
ERGO_HD float lattice_value(std::uint32_t seed, int row, int column, int around) {
  const int wrapped = ((column % around) + around) % around;
  const std::uint32_t point = scrambled(static_cast<std::uint32_t>(row) * 0x9e3779b9U + seed);
  return static_cast<float>(scrambled(point + static_cast<std::uint32_t>(wrapped)) >> 8U) * (2.0F / 16777216.0F) - 1.0F;
}

//! Returns lattice_value() interpolated smoothly between the points of the lattice. `turn`: azimuth
//! [turns]; there is no seam where it wraps around.
ERGO_HD float lattice_noise(std::uint32_t seed, float row, float turn, int around) {
  const float position = turn * static_cast<float>(around);
  const float row_floor = ::floorf(row);
  const float column_floor = ::floorf(position);
  const auto ease = [](float t) { return t * t * (3.0F - 2.0F * t); };
  const float t = ease(row - row_floor);
  const float s = ease(position - column_floor);
  const int i = static_cast<int>(row_floor);
  const int j = static_cast<int>(column_floor);
  const float low = lattice_value(seed, i, j, around) * (1.0F - s) + lattice_value(seed, i, j + 1, around) * s;
  const float high = lattice_value(seed, i + 1, j, around) * (1.0F - s) + lattice_value(seed, i + 1, j + 1, around) * s;
  return low * (1.0F - t) + high * t;
}

//! Returns the clouds of one set, in about [-1, 1]. `blur`: width of a pixel relative to r; clouds
//! smaller than a pixel are left out.
ERGO_HD float cloud_noise(std::uint32_t seed, float log_r, float turn, float blur) {
  float sum = 0.0F;
  float rows = 5.0F;
  float weight = 0.6F;
  int around = 4;
  for (std::uint32_t octave = 0; octave < 4; ++octave) {
    const float seen = minimum(maximum(2.0F - 2.0F * blur * rows, 0.0F), 1.0F);
    sum += seen * weight * lattice_noise(seed + octave * 0x51ed270bU, rows * log_r, turn, around);
    rows *= 2.1F;
    weight *= 0.62F;
    around *= 2;
  }
  return sum;
}

}  // namespace detail

//! Returns the pattern, in about [-1, 1] and with mean 0, of matter that passes (r, φ) at angular
//! velocity `rotation` [1/M], `delay` [M] before the camera sees it. `blur`: width of a pixel
//! relative to r.
ERGO_HD float disk_pattern(const PatternTime& time, float r, float phi, float rotation, float delay, float blur) {
  constexpr float per_turn = 0.15915494F;
  // At the horizon time and azimuth diverge. Matter seen there is dark, so it gets no pattern.
  constexpr float farthest = 1e6F;
  if (!(::fabsf(phi) < farthest && ::fabsf(delay) < farthest)) {
    return 0.0F;
  }
  const float log_r = ::logf(r);
  float sum = 0.0F;
  float squares = 0.0F;
  for (std::uint32_t set = 0; set < 2; ++set) {
    const float shifted = (time.age - delay) / time.period + 0.5F * static_cast<float>(set);
    const float cycles = ::floorf(shifted);
    const float age = shifted - cycles;
    // The flow shears a cloud over its life. A cloud is undistorted in the middle of its life, so
    // that the shear before and after is equally strong.
    const float turn = per_turn * (phi - rotation * time.period * (age - 0.5F));
    const std::uint32_t born = time.cycle + static_cast<std::uint32_t>(static_cast<std::int32_t>(cycles));
    const float weight = 1.0F - ::fabsf(2.0F * age - 1.0F);
    sum += weight * detail::cloud_noise(detail::scrambled(2U * born + set), log_r, turn - ::floorf(turn), blur);
    squares += weight * weight;
  }
  // Keeps the contrast of the sum of two sets equal to that of one set.
  return sum / sqrt(squares);
}

}  // namespace ERGO_TARGET

//! Temperature as a function of radius, as kernels read it: T at equal steps of √(1 - r_0 / r),
//! with which a disk's temperature rises from 0 at its innermost stable orbit r_0.
struct DiskProfileTable {
  const float* temperature;  //!< [K]
  int count;
  float first_r;  //!< r_0, the innermost stable orbit [M]
  float step;
};

//! How a disk looks: its extent, colors, brightness and pattern.
struct DiskAppearance {
  DiskFlow<float> flow;
  float inner_r;  //!< inner edge [M]; outer_r: outer edge [M]
  float outer_r;
  DiskProfileTable profile;
  BlackbodyTable colours;
  float log_unit;  //!< ln of the luminance [cd/m²] that is displayed with the value `exposure`
  float exposure;
  float opacity;
  //! Whether Doppler and gravitational shifts are applied: light of a blackbody of temperature T is
  //! then seen as that of one of temperature g T.
  bool shifted;
  bool limb_darkened;  //!< limb darkening of an electron-scattering atmosphere
  float contrast;      //!< strength of the brightness pattern; 0: no pattern
  PatternTime pattern;
};

//! Returns whether the disk has a pattern. Only then do rays need azimuth and time; kernels have a
//! variant without these.
constexpr bool has_pattern(const DiskAppearance& appearance) { return appearance.contrast > 0.0F; }

}  // namespace ergodome
