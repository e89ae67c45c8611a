#include "content/images/formats/png_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

namespace {

constexpr const char* broken_off = "it is truncated";
constexpr std::uint32_t longest_chunk = 0x7FFF'FFFF;

unsigned long sum_over(unsigned long sum, const char* bytes, std::size_t count) {
  return crc32(sum, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(count));
}

//! Reads the data and checksum that follow a chunk's length and type. Returns what is wrong with
//! them; empty if nothing.
std::string problem_of_chunk(const NextBytes& next, std::uint32_t length, std::string_view kind,
                             std::vector<char>& room) {
  unsigned long sum = sum_over(crc32(0, nullptr, 0), kind.data(), kind.size());
  for (std::size_t left = length; left > 0;) {
    const std::size_t count = std::min(left, room.size());
    if (!next(room.data(), count)) {
      return broken_off;
    }
    sum = sum_over(sum, room.data(), count);
    left -= count;
  }
  std::array<char, 4> saved{};
  if (!next(saved.data(), saved.size())) {
    return broken_off;
  }
  // PNG readers ignore damaged ancillary chunks (first letter in lower case), such as texts and
  // profiles.
  const bool matters = (static_cast<unsigned char>(kind.front()) & 0x20U) == 0;
  return !matters || big_endian_word({saved.data(), saved.size()}) == sum ? ""
                                                                          : "it is damaged: a checksum does not match";
}

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
    // The chunk begins with the white point.
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

//! Passes the type and data of each chunk before the pixels to `take`. Skips chunks with more than
//! `longest` bytes of data.
template <class Take>
void for_each_chunk(const NextBytes& next, std::size_t longest, Take&& take) {
  constexpr std::size_t sum_bytes = 4;
  std::array<char, 8> head{};
  if (!next(head.data(), head.size()) || std::string_view(head.data(), head.size()) != png_signature) {
    return;
  }
  std::vector<char> room(std::size_t{1} << 16U);
  while (next(head.data(), head.size())) {
    const std::size_t length = big_endian_word({head.data(), head.size()});
    const std::string_view kind(head.data() + 4, 4);
    if (kind == "IDAT" || kind == "IEND") {
      return;
    }
    if (length > longest) {
      if (!skip(next, length + sum_bytes, room)) {
        return;
      }
      continue;
    }
    room.resize(std::max(room.size(), length + sum_bytes));
    if (!next(room.data(), length + sum_bytes)) {
      return;
    }
    take(kind, std::string_view(room.data(), length));
  }
}

//! Returns the profile of an iCCP chunk, which is a name, a zero, the compression method and
//! compressed bytes.
std::string unpacked_profile(std::string_view chunk) {
  constexpr std::size_t largest_profile = std::size_t{1} << 24U;
  const std::size_t zero = chunk.find('\0');
  if (zero == std::string_view::npos || zero + 2 > chunk.size()) {
    return "";
  }
  const std::string_view packed = chunk.substr(zero + 2);
  // Deflate compresses by a factor of at most about 1032.
  std::string profile(std::min(largest_profile, std::max<std::size_t>(1100 * packed.size(), 1024)), '\0');
  auto size = static_cast<uLongf>(profile.size());
  // Keeps the bytes before a damaged one: libpng may use them.
  uncompress(reinterpret_cast<Bytef*>(profile.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
             static_cast<uLong>(packed.size()));
  profile.resize(size);
  return profile;
}

}  // namespace

std::uint32_t big_endian_word(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

std::string problem_of_png(const NextBytes& next, PngExtent extent) {
  std::array<char, 8> head{};
  if (!next(head.data(), head.size()) || std::string_view(head.data(), head.size()) != png_signature) {
    return "";
  }
  std::vector<char> room(std::size_t{1} << 16U);
  for (bool pixels = false;;) {
    if (!next(head.data(), head.size())) {
      return broken_off;
    }
    const std::uint32_t length = big_endian_word({head.data(), head.size()});
    const std::string_view kind(head.data() + 4, 4);
    if (kind == "IDAT" && extent == PngExtent::to_pixels) {
      return "";
    }
    if (length > longest_chunk) {
      return "it is damaged: a checksum does not match";
    }
    std::string problem = problem_of_chunk(next, length, kind, room);
    if (!problem.empty()) {
      return problem;
    }
    pixels = pixels || kind == "IDAT";
    if (kind == "IEND") {
      return pixels ? "" : "it contains no pixels";
    }
  }
}

PngColors read_png_colors(const NextBytes& next) {
  constexpr std::size_t longest_color_chunk = 32;
  PngColors colors;
  for_each_chunk(next, longest_color_chunk,
                 [&](std::string_view kind, std::string_view data) { take_color_chunk(kind, data, colors); });
  return colors;
}

std::string png_icc_profile(const NextBytes& next) {
  constexpr std::size_t longest_profile_chunk = std::size_t{1} << 24U;
  std::string profile;
  for_each_chunk(next, longest_profile_chunk, [&](std::string_view kind, std::string_view data) {
    if (kind == "iCCP" && profile.empty()) {
      profile = unpacked_profile(data);
    }
  });
  return profile;
}

}  // namespace ergodome
