#include "render/output/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/image/color_map.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int encoding_table_size = 1 << 16;

//! Returns sRGB bytes of linear light in [0, 1]; where the curve is steepest, entries differ by
//! 0.05 of a byte.
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

//! Returns a channel's display light, 0 to 1. NaN becomes black, because the comparison is false
//! for it.
float display_light(const Picture& picture, std::size_t index) {
  const float light = picture.rgba[index];
  const float shown = picture.heat_range.has_value() ? light : toned(picture.tone, light);
  return shown > 0.0F ? std::min(shown, 1.0F) : 0.0F;
}

//! Computes three values per pixel by applying `encoded` to the display light.
template <class Value, class Encode>
std::vector<Value> display_values(const Picture& picture, const Encode& encoded) {
  std::vector<Value> values(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  parallel_for(picture.height, 16, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin) * static_cast<std::size_t>(picture.width);
         i < static_cast<std::size_t>(end) * static_cast<std::size_t>(picture.width); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        values[3 * i + c] = encoded(display_light(picture, 4 * i + c));
      }
    }
  });
  return values;
}

}  // namespace

std::vector<std::uint8_t> tone_mapped(const Picture& picture) {
  const auto& table = encoding_table();
  return display_values<std::uint8_t>(picture, [&](float light) {
    return table[static_cast<std::size_t>(std::lrint(light * (encoding_table_size - 1)))];
  });
}

std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture) {
  return display_values<std::uint16_t>(picture, [](float light) {
    return static_cast<std::uint16_t>(std::lrint(65535.0F * std::min(srgb_encoded(light), 1.0F)));
  });
}

std::vector<float> coverage_of(const Picture& picture) {
  std::vector<float> coverage(picture.rgba.size() / 4);
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    coverage[i] = std::clamp(picture.rgba[4 * i + 3], 0.0F, 1.0F);
  }
  return coverage;
}

}  // namespace ergodome
