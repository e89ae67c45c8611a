#include "render/output/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/image/color_map.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int table_size = 1 << 16;

//! sRGB bytes of linear light in [0, 1]; at its steepest the curve passes 0.05 of a byte an entry.
const std::array<std::uint8_t, table_size>& encoding_table() {
  static const auto table = [] {
    std::array<std::uint8_t, table_size> bytes{};
    for (int i = 0; i < table_size; ++i) {
      const float encoded = srgb_encoded(static_cast<float>(i) / (table_size - 1));
      bytes[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(encoded, 0.0F, 1.0F)));
    }
    return bytes;
  }();
  return table;
}

}  // namespace

std::vector<std::uint8_t> tone_mapped(const Picture& picture) {
  const auto& table = encoding_table();
  const bool heat_map = picture.heat_range.has_value();
  std::vector<std::uint8_t> bytes(3 * static_cast<std::size_t>(picture.width) *
                                  static_cast<std::size_t>(picture.height));
  parallel_for(picture.height, 16, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin) * static_cast<std::size_t>(picture.width);
         i < static_cast<std::size_t>(end) * static_cast<std::size_t>(picture.width); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = picture.rgba[4 * i + c];
        const float shown = heat_map ? light : toned(picture.tone, light);
        // The comparison is false for NaN, which becomes black.
        const float clamped = shown > 0.0F ? std::min(shown, 1.0F) : 0.0F;
        bytes[3 * i + c] = table[static_cast<std::size_t>(std::lrint(clamped * (table_size - 1)))];
      }
    }
  });
  return bytes;
}

}  // namespace ergodome
