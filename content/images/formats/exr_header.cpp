#include "content/images/formats/exr_header.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>

namespace ergodome {

namespace {

constexpr std::string_view exr_magic("\x76\x2F\x31\x01", 4);
constexpr const char* damaged_header = "its header is damaged";

std::optional<std::uint32_t> little_endian_word(const NextBytes& next) {
  std::array<char, 4> bytes{};
  if (!next(bytes.data(), bytes.size())) {
    return std::nullopt;
  }
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    value = value << 8U | static_cast<unsigned char>(bytes.at(i));
  }
  return value;
}

//! Reads a zero-terminated name. Returns nothing if it is longer than OpenEXR allows.
std::optional<std::string> name_of(const NextBytes& next) {
  constexpr std::size_t longest_name = 255;
  std::string name;
  char letter = '\0';
  while (next(&letter, 1) && name.size() <= longest_name) {
    if (letter == '\0') {
      return name;
    }
    name += letter;
  }
  return std::nullopt;
}

bool skip_bytes(const NextBytes& next, std::uint64_t count) {
  std::array<char, 4096> room{};
  for (; count > 0; count -= std::min<std::uint64_t>(count, room.size())) {
    if (!next(room.data(), std::min<std::size_t>(count, room.size()))) {
      return false;
    }
  }
  return true;
}

//! An attribute type of fixed size. OpenEXR reads that many bytes, whatever size the file claims.
struct FixedKind {
  std::string_view name;
  std::uint32_t bytes;
};

constexpr FixedKind fixed_kinds[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

//! Reads a list of channels, which ends with an empty name. Returns true if it ends where its size
//! says.
bool is_channel_list_whole(const NextBytes& next, std::uint64_t size) {
  constexpr std::uint64_t channel_bytes = 16;
  while (size > 0) {
    const std::optional<std::string> name = name_of(next);
    if (!name || size < name->size() + 1) {
      return false;
    }
    size -= name->size() + 1;
    if (name->empty()) {
      return size == 0;
    }
    if (size < channel_bytes || !skip_bytes(next, channel_bytes)) {
      return false;
    }
    size -= channel_bytes;
  }
  return false;
}

//! Reads an attribute after its name: type, size and value. Returns false if they are damaged.
bool is_attribute_whole(const NextBytes& next, std::uintmax_t file_bytes) {
  constexpr std::uint64_t preview_head = 8;
  const std::optional<std::string> kind = name_of(next);
  const std::optional<std::uint32_t> size = kind ? little_endian_word(next) : std::nullopt;
  if (!size || *size > file_bytes) {
    return false;
  }
  if (*kind == "chlist") {
    return is_channel_list_whole(next, *size);
  }
  const auto* const fixed = std::ranges::find(fixed_kinds, std::string_view(*kind), &FixedKind::name);
  if (*kind != "preview") {
    return (fixed == std::end(fixed_kinds) || fixed->bytes == *size) && skip_bytes(next, *size);
  }
  // OpenEXR allocates memory for the preview by its width and height.
  const std::optional<std::uint32_t> width = little_endian_word(next);
  const std::optional<std::uint32_t> height = width ? little_endian_word(next) : std::nullopt;
  return height && *size >= preview_head && *width <= file_bytes && *height <= file_bytes &&
         std::uint64_t{*width} * *height * 4 == *size - preview_head && skip_bytes(next, *size - preview_head);
}

}  // namespace

std::string problem_of_exr(const NextBytes& next, std::uintmax_t file_bytes) {
  std::array<char, 4> magic{};
  if (!next(magic.data(), magic.size()) || std::string_view(magic.data(), magic.size()) != exr_magic) {
    return "";
  }
  constexpr std::uint32_t multi_part = 0x1000;
  const std::optional<std::uint32_t> version = little_endian_word(next);
  if (!version) {
    return damaged_header;
  }
  // In a file of several parts, an empty header follows the last one.
  for (bool empty = true;;) {
    const std::optional<std::string> name = name_of(next);
    if (!name) {
      return damaged_header;
    }
    if (name->empty()) {
      if (empty || (*version & multi_part) == 0) {
        return "";
      }
      empty = true;
      continue;
    }
    empty = false;
    if (!is_attribute_whole(next, file_bytes)) {
      return damaged_header;
    }
  }
}

}  // namespace ergodome
