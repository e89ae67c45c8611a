#include "content/images/formats/exr_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
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

//! Reads a list of channels, which ends with an empty name. Returns true if the list ends exactly
//! after `size` bytes.
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
  // OpenEXR allocates memory for the preview by its width and height, so these must fit the
  // attribute's size.
  const std::optional<std::uint32_t> width = little_endian_word(next);
  const std::optional<std::uint32_t> height = width ? little_endian_word(next) : std::nullopt;
  return height && *size >= preview_head && *width <= file_bytes && *height <= file_bytes &&
         std::uint64_t{*width} * *height * 4 == *size - preview_head && skip_bytes(next, *size - preview_head);
}

std::string in_small_letters(std::string_view text) {
  std::string small;
  std::ranges::transform(text, std::back_inserter(small),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

//! Returns the name of a channel or layer after its last dot, in lower case.
std::string last_word(std::string_view name) {
  const std::size_t point = name.rfind('.');
  return in_small_letters(point == std::string_view::npos ? name : name.substr(point + 1));
}

std::string layer_of(std::string_view channel) {
  const std::size_t point = channel.rfind('.');
  return std::string(point == std::string_view::npos ? std::string_view() : channel.substr(0, point));
}

bool is_channel(std::string_view name, std::string_view letter, std::string_view word) {
  const std::string last = last_word(name);
  return last == letter || last == word;
}

//! Returns the layer that begins with channels[first]: red, green and blue in this order, or a
//! luminance, and alpha if it follows. Otherwise the result has no channels.
ExrLayer layer_at(const std::vector<std::string>& channels, std::size_t first) {
  const std::string layer_name = layer_of(channels[first]);
  const auto is = [&](std::size_t at, std::string_view letter, std::string_view word) {
    return at < channels.size() && layer_of(channels[at]) == layer_name && is_channel(channels[at], letter, word);
  };
  ExrLayer layer;
  layer.name = layer_name;
  layer.first_channel = static_cast<int>(first);
  if (is(first, "r", "red") && is(first + 1, "g", "green") && is(first + 2, "b", "blue")) {
    layer.channels = 3;
  } else if (is(first, "y", "luminance")) {
    layer.channels = 1;
  }
  if (layer.channels > 0 && is(first + static_cast<std::size_t>(layer.channels), "a", "alpha")) {
    layer.alpha = layer.channels++;
  }
  return layer;
}

std::string list_of(const std::vector<ExrLayer>& layers) {
  std::string list;
  for (const ExrLayer& layer : layers) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", layer.name.empty() ? "plain RGB" : layer.name);
  }
  return list;
}

std::vector<ExrLayer> layers_called(const std::vector<ExrLayer>& layers, const std::string& name) {
  const std::string wanted = in_small_letters(name);
  std::vector<ExrLayer> found;
  std::ranges::copy_if(layers, std::back_inserter(found),
                       [&](const ExrLayer& layer) { return in_small_letters(layer.name) == wanted; });
  if (found.empty()) {
    std::ranges::copy_if(layers, std::back_inserter(found),
                         [&](const ExrLayer& layer) { return last_word(layer.name) == wanted; });
  }
  return found;
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
  // In a file of several parts, an empty header after the last one ends the headers.
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

std::vector<ExrLayer> exr_layers(const std::vector<ExrPart>& parts) {
  std::vector<ExrLayer> layers;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::vector<std::string>& channels = parts[part].channels;
    if (parts[part].view != parts.front().view) {
      continue;
    }
    const std::size_t before = layers.size();
    for (std::size_t first = 0; first < channels.size(); ++first) {
      ExrLayer layer = layer_at(channels, first);
      if (layer.channels > 0) {
        layer.part = static_cast<int>(part);
        layers.push_back(layer);
        first += static_cast<std::size_t>(layer.channels) - 1;
      }
    }
    if (layers.size() == before && channels.size() == 1) {
      layers.push_back({layer_of(channels[0]), static_cast<int>(part), 0, 1, -1});
    }
  }
  const auto plain = std::ranges::count_if(layers, [](const ExrLayer& layer) { return layer.name.empty(); });
  for (ExrLayer& layer : layers) {
    if (plain > 1 && layer.name.empty()) {
      const std::string& part_name = parts[static_cast<std::size_t>(layer.part)].name;
      layer.name = part_name.empty() ? fmt::format("part {}", layer.part) : part_name;
    }
  }
  return layers;
}

ExrLayer choose_exr_layer(const std::vector<ExrLayer>& layers, const std::string& name, std::string& problem) {
  if (layers.empty()) {
    problem = "it has no layer with red, green and blue channels";
    return {};
  }
  std::vector<ExrLayer> found;
  if (name.empty()) {
    constexpr std::array<const char*, 4> main_names = {"", "combined", "rgba", "beauty"};
    for (auto main_name = main_names.begin(); main_name != main_names.end() && found.empty(); ++main_name) {
      found = layers_called(layers, *main_name);
    }
    found = found.empty() && layers.size() == 1 ? layers : found;
  } else {
    found = layers_called(layers, name);
  }
  if (found.size() == 1) {
    return found.front();
  }
  if (name.empty() || found.size() > 1) {
    problem =
        fmt::format("it has several layers; append #LAYER to the file name to choose one of: {}", list_of(layers));
  } else {
    problem = fmt::format("it has no layer \"{}\"; available: {}", name, list_of(layers));
  }
  return {};
}

}  // namespace ergodome
