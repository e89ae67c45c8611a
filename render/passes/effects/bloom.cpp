#include "render/passes/effects/bloom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int band_rows = 16;
//! Number of pixels that the widest filter reads beyond the ends of a row.
constexpr int margin = 3;

//! Downsampling filter of Jimenez, with 13 taps, each the mean of 2 x 2 pixels: the sum of an inner
//! box and of four outer boxes, each with half of the weight. Both sums are separable. The filter
//! gives every pixel the same total weight and does not shift the picture.
constexpr std::array<float, 6> inner_taps = {0.0F, 0.25F, 0.25F, 0.25F, 0.25F, 0.0F};
constexpr std::array<float, 6> outer_taps = {0.125F, 0.125F, 0.25F, 0.25F, 0.125F, 0.125F};

//! Weights along one axis for upsampling with a 3 x 3 tent filter of bilinear reads, for the first
//! of the two fine pixels in each coarse one. The weights for the second one are reversed.
constexpr std::array<float, 4> tent_taps = {0.0625F, 0.3125F, 0.4375F, 0.1875F};
constexpr std::array<float, 4> reversed_tent_taps = {0.1875F, 0.4375F, 0.3125F, 0.0625F};

//! A picture of one level of the chain: rows of four floats per pixel.
struct Level {
  int width;
  int height;
  float* rgba;

  [[nodiscard]] float* row(int y) const {
    return rgba + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

//! Returns the index within [0, count) to which `i` is mapped by mirroring at both ends.
int mirrored(int i, int count) {
  const int period = 2 * count;
  const int within = ((i % period) + period) % period;
  return within < count ? within : period - 1 - within;
}

std::size_t folded_size(int width) { return 4 * static_cast<std::size_t>(width + 2 * margin); }

//! Computes the weighted sum of several rows, the first of which is `first`, and extends it at both
//! ends by mirroring. Non-finite values count as 0.
void fold_rows(const Level& from, int first, std::span<const float> taps, float* folded) {
  const int count = 4 * from.width;
  float* inside = folded + 4 * margin;
  std::fill_n(inside, count, 0.0F);
  for (std::size_t j = 0; j < taps.size(); ++j) {
    const float* row = from.row(mirrored(first + static_cast<int>(j), from.height));
    for (int i = 0; i < count; ++i) {
      // The comparison is false for NaN.
      inside[i] += taps[j] * (std::abs(row[i]) <= std::numeric_limits<float>::max() ? row[i] : 0.0F);
    }
  }
  for (int i = 1; i <= margin; ++i) {
    std::copy_n(inside + 4 * mirrored(-i, from.width), 4, inside - 4 * i);
    std::copy_n(inside + 4 * mirrored(from.width - 1 + i, from.width), 4, inside + 4 * (from.width - 1 + i));
  }
}

//! Returns the weighted sum of successive pixels of a row from fold_rows(), the first of which is
//! `first`.
template <std::size_t Count>
float fold_pixels(const float* folded, int first, int channel, const std::array<float, Count>& taps) {
  const float* at = folded + 4 * (first + margin) + channel;
  float sum = 0.0F;
  for (std::size_t i = 0; i < Count; ++i) {
    sum += taps[i] * at[4 * i];
  }
  return sum;
}

//! Calls body(y, scratch) for all rows, in bands that run in parallel. Each band has its own
//! `scratch` of scratch_size floats.
template <class Body>
void for_rows(int rows, std::size_t scratch_size, const Body& body) {
  const int bands = (rows + band_rows - 1) / band_rows;
  std::vector<float> scratch(static_cast<std::size_t>(bands) * scratch_size);
  parallel_for(bands, 1, [&](int begin, int end) {
    for (int y = begin * band_rows; y < std::min(end * band_rows, rows); ++y) {
      body(y, scratch.data() + static_cast<std::size_t>(begin) * scratch_size);
    }
  });
}

//! Downsamples `from` to `to`, whose size is half of that, rounded up.
void halve(const Level& from, const Level& to) {
  const std::size_t size = folded_size(from.width);
  for_rows(to.height, 2 * size, [&](int y, float* scratch) {
    float* inner = scratch;
    float* outer = scratch + size;
    fold_rows(from, 2 * y - 2, inner_taps, inner);
    fold_rows(from, 2 * y - 2, outer_taps, outer);
    float* row = to.row(y);
    for (int x = 0; x < to.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        row[4 * x + c] =
            0.5F * (fold_pixels(inner, 2 * x - 2, c, inner_taps) + fold_pixels(outer, 2 * x - 2, c, outer_taps));
      }
    }
  });
}

//! Computes to = keep * to + gain * (upsampled from), for the color channels only.
void mix_doubled(const Level& from, const Level& to, float keep, float gain) {
  for_rows(to.height, folded_size(from.width), [&](int y, float* folded) {
    const bool second_row = y % 2 != 0;
    fold_rows(from, y / 2 - (second_row ? 1 : 2), second_row ? reversed_tent_taps : tent_taps, folded);
    float* row = to.row(y);
    for (int x = 0; x < to.width; ++x) {
      const int coarse = x / 2;
      for (int c = 0; c < 3; ++c) {
        const float light = x % 2 != 0 ? fold_pixels(folded, coarse - 1, c, reversed_tent_taps)
                                       : fold_pixels(folded, coarse - 2, c, tent_taps);
        row[4 * x + c] = keep * row[4 * x + c] + gain * light;
      }
    }
  });
}

//! Returns the variance along an axis of the light of a point after `level` downsamplings and as
//! many upsamplings [px²]. Each downsampling adds 7/4 and each upsampling 11/4, in pixels of its
//! finer level.
double level_variance(int level) { return 1.5 * (std::pow(4.0, level) - 1.0); }

//! Returns the fractions of the scattered light that pass through levels 1, 2, ... All but the last
//! are equal. The last one is such that the total has the requested variance, or the largest that
//! `max_levels` levels allow. The fractions add up to 1, or to less if the variance is below that
//! of level 1: the rest of the light stays in its pixel.
std::vector<double> level_parts(double variance, int max_levels) {
  if (variance < level_variance(1)) {
    return {variance / level_variance(1)};
  }
  std::vector<double> parts;
  double sum = 0.0;  // of the variances of the levels so far
  double count = 0.0;
  for (int level = 1; level <= max_levels; ++level) {
    // Solves (sum + last * level_variance) / (count + last) = variance.
    const double own = level_variance(level);
    const double last = own > variance ? std::min((variance * count - sum) / (own - variance), 1.0) : 1.0;
    parts.push_back(last);
    sum += last * own;
    count += last;
    if (last < 1.0) {
      break;
    }
  }
  for (double& part : parts) {
    part /= count;
  }
  return parts;
}

//! Returns the number of times that a picture can be halved until one pixel is left.
int halvings(int width, int height) {
  int count = 0;
  for (int size = std::max(width, height); size > 1; size = (size + 1) / 2) {
    ++count;
  }
  return count;
}

}  // namespace

void add_bloom(Picture& picture, const BloomSettings& settings) {
  const int max_levels = std::min(picture.width, picture.height) > 0 ? halvings(picture.width, picture.height) : 0;
  if (!(settings.strength > 0.0) || !(settings.radius_px > 0.0) || max_levels == 0) {
    return;
  }
  const std::vector<double> parts = level_parts(settings.radius_px * settings.radius_px, max_levels);
  std::vector<Level> levels = {{picture.width, picture.height, picture.rgba.data()}};
  std::vector<std::vector<float>> pixels;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const int width = (levels.back().width + 1) / 2;
    const int height = (levels.back().height + 1) / 2;
    pixels.emplace_back(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    levels.push_back({width, height, pixels.back().data()});
    halve(levels[i], levels[i + 1]);
  }
  const std::size_t last = parts.size();
  const double strength = std::min(settings.strength, 1.0);
  double gain = parts[last - 1];
  for (std::size_t i = last - 1; i > 0; --i) {
    mix_doubled(levels[i + 1], levels[i], static_cast<float>(parts[i - 1]), static_cast<float>(gain));
    gain = 1.0;
  }
  const double scattered = last == 1 ? strength * parts[0] : strength;
  mix_doubled(levels[1], levels[0], static_cast<float>(1.0 - scattered), static_cast<float>(scattered));
}

}  // namespace ergodome
