#include "render/present/projectors/master_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ergodome {

LightTiles::LightTiles(int width, int height) {
  const int levels =
      std::min(static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height)))), max_light_levels);
  for (int i = 0; i < levels; ++i) {
    const int across = std::max(width >> i, 1);
    const int down = std::max(height >> i, 1);
    levels_.push_back({across, down,
                       std::vector<std::uint8_t>(static_cast<std::size_t>(light_tiles(across)) *
                                                 static_cast<std::size_t>(light_tiles(down)))});
  }
}

void LightTiles::want(int level, int left, int right, int top, int bottom) {
  Level& at = levels_[static_cast<std::size_t>(level)];
  const int across = light_tiles(at.width);
  const int last_column = std::min(right, at.width - 1) / light_tile_px;
  const int last_row = std::min(bottom, at.height - 1) / light_tile_px;
  for (int row = std::max(top, 0) / light_tile_px; row <= last_row; ++row) {
    for (int column = std::max(left, 0) / light_tile_px; column <= last_column; ++column) {
      const int tile = row * across + column;
      at.wanted[static_cast<std::size_t>(tile)] = 1;
    }
  }
}

void LightTiles::join(const LightTiles& other) {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    std::ranges::transform(levels_[i].wanted, other.levels_[i].wanted, levels_[i].wanted.begin(),
                           [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
  }
}

void LightTiles::complete() {
  for (int level = level_count() - 1; level > 0; --level) {
    const double wider = static_cast<double>(width(level - 1)) / width(level);
    const double higher = static_cast<double>(height(level - 1)) / height(level);
    for (const std::int32_t tile : tiles(level)) {
      const int left = tile % light_tiles(width(level)) * light_tile_px;
      const int top = tile / light_tiles(width(level)) * light_tile_px;
      want(level - 1, static_cast<int>(wider * left), static_cast<int>(std::ceil(wider * (left + light_tile_px))),
           static_cast<int>(higher * top), static_cast<int>(std::ceil(higher * (top + light_tile_px))));
    }
  }
}

std::vector<std::int32_t> LightTiles::tiles(int level) const {
  const std::vector<std::uint8_t>& wanted = levels_[static_cast<std::size_t>(level)].wanted;
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] != 0) {
      numbers.push_back(static_cast<std::int32_t>(i));
    }
  }
  return numbers;
}

MasterPicture master_picture(const Picture& picture) {
  return {picture.rgba.data(), picture.width, picture.height, picture.heat_range.has_value(), picture.tone};
}

MasterLight::MasterLight(const LightTiles& tiles, Backend backend) : backend_(backend) {
  levels_.count = tiles.level_count();
  for (int i = 0; i < tiles.level_count(); ++i) {
    const std::size_t texels = static_cast<std::size_t>(tiles.width(i)) * static_cast<std::size_t>(tiles.height(i));
    const Buffer<float>& memory = memory_.emplace_back(backend, 4 * (texels + 1), "master light");
    // Clears the memory: pixels also read texels that are not needed, with weight 0, from a coarser
    // level or beside lit parts. These must not be NaN.
    clear(backend, memory, memory.size());
    levels_.level[i] = {memory.data(), tiles.width(i), tiles.height(i)};
    tiles_.emplace_back(backend, tiles.tiles(i), "master light's tiles");
  }
}

void MasterLight::update(const MasterPicture& picture) {
  for (int i = 0; i < levels_.count; ++i) {
    const Buffer<std::int32_t>& tiles = tiles_[static_cast<std::size_t>(i)];
    const int count = static_cast<int>(tiles.size());
    if (i == 0) {
      launch(backend_, ToneBatch{picture.rgba, levels_.level[0], picture.tone, picture.heat_map, tiles.data(), count});
    } else if (count > 0) {
      launch(backend_, AverageBatch{levels_.level[i - 1], levels_.level[i], tiles.data(), count});
    }
  }
}

}  // namespace ergodome
