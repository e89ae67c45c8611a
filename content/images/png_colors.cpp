#include "content/images/png_colors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace ergodome {

namespace {

void take_color_chunk(std::string_view kind, std::string_view data, PngColors& colors) {
  constexpr double unit = 100'000.0;
  if (kind == "cICP" && data.size() == 4) {
    const auto number = [&](std::size_t at) { return static_cast<int>(static_cast<unsigned char>(data[at])); };
    colors.code_points = CodePoints{number(0), number(1), number(2), number(3) != 0};
  } else if (kind == "sRGB" && data.size() == 1) {
    colors.is_srgb = true;
  } else if (kind == "gAMA" && data.size() == 4) {
    colors.gamma = big_endian_word(data) / unit;
  } else if (kind == "cHRM" && data.size() == 32) {
    // The chunk begins with white.
    std::array<double, 8> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values.at((i + 6) % 8) = big_endian_word(data.substr(4 * i)) / unit;
    }
    colors.primaries = values;
  }
}

bool skip(const NextBytes& next, std::size_t count, std::vector<char>& room) {
  while (count > 0) {
    const std::size_t part = std::min(count, room.size());
    if (!next(room.data(), part)) {
      return false;
    }
    count -= part;
  }
  return true;
}

}  // namespace

PngColors read_png_colors(const NextBytes& next) {
  constexpr std::size_t longest_color_chunk = 32;
  constexpr std::size_t sum_bytes = 4;
  PngColors colors;
  std::array<char, 8> head{};
  if (!next(head.data(), head.size()) || std::string_view(head.data(), head.size()) != png_signature) {
    return colors;
  }
  std::vector<char> room(std::size_t{1} << 16U);
  while (next(head.data(), head.size())) {
    const std::size_t length = big_endian_word({head.data(), head.size()});
    const std::string_view kind(head.data() + 4, 4);
    if (kind == "IDAT" || kind == "IEND") {
      break;
    }
    if (length > longest_color_chunk) {
      if (!skip(next, length + sum_bytes, room)) {
        break;
      }
      continue;
    }
    if (!next(room.data(), length + sum_bytes)) {
      break;
    }
    take_color_chunk(kind, {room.data(), length}, colors);
  }
  return colors;
}

}  // namespace ergodome
