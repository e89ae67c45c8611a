#include "content/images/formats/png_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
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

}  // namespace ergodome
