#include "render/output/tone_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "kernels/core/pack.h"
#include "kernels/image/color_map.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {

constexpr int encoding_table_size = 1 << 16;

//! Returns a table of sRGB bytes for linear light in [0, 1]. Where the curve is steepest,
//! successive entries differ by 0.05 of a byte.
const std::array<std::uint8_t, encoding_table_size>& encoding_table() {
  static const auto table = [] {
    std::array<std::uint8_t, encoding_table_size> bytes{};
    for (int i = 0; i < encoding_table_size; ++i) {
      const float encoded = srgb_encoded(static_cast<float>(i) / (encoding_table_size - 1));
      bytes[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(encoded, 0.0F, 1.0F)));
    }
    return bytes;
  }();
  return table;
}

//! Computes display light, 0 to 1, from the light of a channel.
class ChannelTone {
 public:
  explicit ChannelTone(const Picture& picture)
      : tone_(picture.tone),
        is_display_(picture.heat_range.has_value()),
        gain_(is_display_ ? 1.0F : tone_.gain),
        linear_to_(is_display_                          ? 1.0F
                   : tone_.curve == ToneCurve::shoulder ? tone_knee
                                                        : 0.0F) {}

  //! Computes the display light of a pixel; NaN becomes black. Returns true if all three colors are in the linear part of
  //! the curve, as most are; otherwise `shown` is not valid.
  bool is_linear(const float* rgba, Pack<float, 4>& shown) const {
    Pack<float, 4> gained;
    std::memcpy(&gained, rgba, sizeof gained);
    gained = gained * gain_;
    set_lane(gained, 3, 0.0F);
    const Pack<float, 4> black(0.0F);
    shown = minimum(select(gained > black, gained, black), Pack<float, 4>(1.0F));
    return !any(gained > Pack<float, 4>(linear_to_));
  }

  float operator()(float light) const {
    const float gained = gain_ * light;
    if (gained <= linear_to_) {
      return gained > 0.0F ? gained : 0.0F;
    }
    const float shown = is_display_ ? light : toned(tone_, light);
    // NaN becomes black, because the comparison is false for it.
    return shown > 0.0F ? std::min(shown, 1.0F) : 0.0F;
  }

 private:
  Tone tone_;
  bool is_display_;
  float gain_;
  float linear_to_;  //!< gained light up to which the curve is the identity
};

//! Computes values of pixels: encode(rgba, to) writes those of a pixel.
template <class Value, class Encode>
std::vector<Value> display_values(const Picture& picture, std::size_t channels, const Encode& encode) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<Value> values(channels * width * static_cast<std::size_t>(picture.height));
  parallel_for(picture.height, 16, [&](int begin, int end) {
    const Encode encode_pixel = encode;
    for (std::size_t i = static_cast<std::size_t>(begin) * width; i < static_cast<std::size_t>(end) * width; ++i) {
      encode_pixel(picture.rgba.data() + 4 * i, values.data() + channels * i);
    }
  });
  return values;
}

//! The four channels of a pixel.
using Channels = Pack<float, 4>;

//! Returns the indices into encoding_table() for the three colors of a pixel; the fourth number is unused.
std::array<std::uint32_t, 4> table_indices(const ChannelTone& tone, const float* rgba) {
  Channels shown;
  if (!tone.is_linear(rgba, shown)) {
    for (int c = 0; c < 3; ++c) {
      set_lane(shown, c, tone(rgba[c]));
    }
  }
  // Adding 1.5 * 2^23 rounds to integers, in the last bits of the float.
  constexpr float integers_from = 12'582'912.0F;
  const Channels rounded = shown * (encoding_table_size - 1.0F) + integers_from;
  std::array<std::uint32_t, 4> indices;
  std::memcpy(indices.data(), &rounded, sizeof indices);
  for (std::uint32_t& index : indices) {
    index -= std::bit_cast<std::uint32_t>(integers_from);
  }
  return indices;
}

//! Computes sRGB bytes of pixels; a fourth channel has the largest value.
template <std::size_t channels>
std::vector<std::uint8_t> display_bytes(const Picture& picture) {
  const std::uint8_t* const table = encoding_table().data();
  const ChannelTone tone(picture);
  return display_values<std::uint8_t>(picture, channels, [table, tone](const float* rgba, std::uint8_t* to) {
    const std::array<std::uint32_t, 4> indices = table_indices(tone, rgba);
    for (std::size_t c = 0; c < 3; ++c) {
      to[c] = table[indices[c]];
    }
    if constexpr (channels == 4) {
      to[3] = std::numeric_limits<std::uint8_t>::max();
    }
  });
}

}  // namespace

std::vector<std::uint8_t> tone_mapped(const Picture& picture) { return display_bytes<3>(picture); }

std::vector<std::uint8_t> tone_mapped_rgba(const Picture& picture) { return display_bytes<4>(picture); }

std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture) {
  const ChannelTone tone(picture);
  return display_values<std::uint16_t>(picture, 3, [tone](const float* rgba, std::uint16_t* to) {
    for (std::size_t c = 0; c < 3; ++c) {
      to[c] = static_cast<std::uint16_t>(std::lrint(65535.0F * std::min(srgb_encoded(tone(rgba[c])), 1.0F)));
    }
  });
}

std::vector<float> coverage_of(const Picture& picture) {
  std::vector<float> coverage(picture.rgba.size() / 4);
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    coverage[i] = std::clamp(picture.rgba[4 * i + 3], 0.0F, 1.0F);
  }
  return coverage;
}

namespace {
constexpr float darkest = 1e-5F;
}  // namespace

void LightMeter::add(const Picture& picture) {
  static WorkCounter counter("meter_light");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
    const float* pixel = picture.rgba.data() + i;
    const float luminance = 0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2];
    // Ignores the shadow and pixels outside the image.
    if (pixel[3] > 0.5F && std::isfinite(luminance)) {
      sum_ += static_cast<double>(std::log2(std::max(luminance, darkest)));
      count_ += 1.0;
    }
  }
}

double LightMeter::middle_light() const { return count_ > 0.0 ? std::exp2(sum_ / count_) : 0.0; }

void AutoExposure::go_on_from(double stops) {
  started_ = true;
  stops_ = stops;
}

double AutoExposure::follow(double middle_light, double seconds) {
  const double wished = middle_light > 0.0 ? std::log2(settings_.target / middle_light) : stops_;
  const double goal = std::clamp(wished, settings_.least_stops, settings_.most_stops);
  const double part =
      !started_ || !(settings_.adapt_s > 0.0) ? 1.0 : 1.0 - std::exp(-std::max(seconds, 0.0) / settings_.adapt_s);
  started_ = true;
  stops_ += part * (goal - stops_);
  return stops_;
}

}  // namespace ergodome
