#include "content/images/exr_header.h"

#include <algorithm>
#include <array>
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

//! Reads a name, which ends with a zero; nothing if it is longer than any.
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

//! Reads an attribute after its name: kind, size and value.
bool is_attribute_whole(const NextBytes& next, std::uintmax_t file_bytes) {
  constexpr std::uint64_t preview_head = 8;
  const std::optional<std::string> kind = name_of(next);
  const std::optional<std::uint32_t> size = kind ? little_endian_word(next) : std::nullopt;
  if (!size || *size > file_bytes) {
    return false;
  }
  if (*kind != "preview") {
    return skip_bytes(next, *size);
  }
  // The library allocates by the size of this picture.
  const std::optional<std::uint32_t> width = little_endian_word(next);
  const std::optional<std::uint32_t> height = width ? little_endian_word(next) : std::nullopt;
  return height && *size >= preview_head && *width <= file_bytes && *height <= file_bytes &&
         std::uint64_t{*width} * *height <= (*size - preview_head) / 4 && skip_bytes(next, *size - preview_head);
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
  // In a file of several parts, an empty header ends them.
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
