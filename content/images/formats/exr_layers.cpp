#include "content/images/formats/exr_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace ergodome {

namespace {

std::string in_small_letters(std::string_view text) {
  std::string small;
  std::ranges::transform(text, std::back_inserter(small),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

//! Returns a channel's name after its last dot, in lower case.
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

//! Returns the layer whose first channel is channels[first]; without channels if that is not a
//! color.
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
