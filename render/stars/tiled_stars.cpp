#include "render/stars/tiled_stars.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "kernels/launch/launch.h"
#include "render/stars/picture_sheets.h"

namespace ergodome {

namespace {

//! Calls body(tile) for each tile of a picture that pixels within `reach_px` of a point lie in, once for each turn of a picture that
//! wraps around: neighbours may come twice.
template <class Body>
void for_tiles_about(const StarPoint& point, const Projection& projection, double reach_px, const Body& body) {
  const auto last_of = [](double place, int size) {
    return static_cast<int>(std::clamp(std::floor(place), -1.0, static_cast<double>(size - 1)));
  };
  const auto first_of = [](double place, int size) {
    return static_cast<int>(std::clamp(std::floor(place), 0.0, static_cast<double>(size)));
  };
  const int columns = (projection.width_px + star_tile_px - 1) / star_tile_px;
  const int top = first_of(point.y_px - reach_px, projection.height_px);
  const int bottom = last_of(point.y_px + reach_px, projection.height_px);
  const int turns = wraps_around(projection) ? 1 : 0;
  for (int turn = -turns; turn <= turns; ++turn) {
    const double x = point.x_px + turn * projection.width_px;
    const int left = first_of(x - reach_px, projection.width_px);
    const int right = last_of(x + reach_px, projection.width_px);
    for (int row = top / star_tile_px; top <= bottom && row <= bottom / star_tile_px; ++row) {
      for (int column = left / star_tile_px; left <= right && column <= right / star_tile_px; ++column) {
        body(row * columns + column);
      }
    }
  }
}

template <class T>
void reserve(Backend backend, std::size_t count, const char* name, Buffer<T>& buffer) {
  if (buffer.size() < count) {
    // Stars come and go: a picture more or less than the last shall not ask for memory anew.
    buffer = Buffer<T>(backend, count + count / 4, name);
  }
}

}  // namespace

StarTiles star_tiles(std::span<const StarPoint> points, std::span<const std::int32_t> chosen,
                     const Projection& projection, double reach_px) {
  StarTiles made;
  made.columns = (projection.width_px + star_tile_px - 1) / star_tile_px;
  const int rows = (projection.height_px + star_tile_px - 1) / star_tile_px;
  const auto tiles = static_cast<std::size_t>(made.columns) * static_cast<std::size_t>(rows);
  std::vector<std::int32_t> counts(tiles, 0);
  std::vector<std::int32_t> latest(tiles, -1);
  const auto for_new_tiles = [&](const auto& body) {
    std::ranges::fill(latest, -1);
    for (const std::int32_t number : chosen) {
      for_tiles_about(points[static_cast<std::size_t>(number)], projection, reach_px, [&](int tile) {
        if (std::exchange(latest[static_cast<std::size_t>(tile)], number) != number) {
          body(static_cast<std::size_t>(tile), number);
        }
      });
    }
  };
  for_new_tiles([&](std::size_t tile, std::int32_t) { counts[tile] += 1; });
  std::int32_t sum = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    if (counts[tile] > 0) {
      made.tiles.push_back(static_cast<std::int32_t>(tile));
      made.first.push_back(sum);
      // From here on, where the tile's next point goes.
      sum += std::exchange(counts[tile], sum);
    }
  }
  made.first.push_back(sum);
  made.members.resize(static_cast<std::size_t>(sum));
  for_new_tiles(
      [&](std::size_t tile, std::int32_t number) { made.members[static_cast<std::size_t>(counts[tile]++)] = number; });
  return made;
}

void TiledStars::place(const StarTiles& tiles, std::size_t points, Placed& placed) const {
  placed.tiles = static_cast<int>(tiles.tiles.size());
  placed.points = static_cast<int>(points);
  placed.columns = tiles.columns;
  std::vector<std::int32_t> numbers = tiles.tiles;
  numbers.insert(numbers.end(), tiles.first.begin(), tiles.first.end());
  numbers.insert(numbers.end(), tiles.members.begin(), tiles.members.end());
  reserve(backend_, numbers.size(), "star tiles", placed.numbers);
  placed.numbers.write(numbers.data(), numbers.size());
}

void TiledStars::set(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& splat,
                     const DiffractionPattern* pattern) {
  projection_ = projection;
  splat_ = splat;
  spots_.tiles = 0;
  spikes_.tiles = 0;
  if (points.empty()) {
    return;
  }
  reserve(backend_, points.size(), "star points", points_);
  points_.write(points.data(), points.size());
  std::vector<std::int32_t> chosen(points.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  place(star_tiles(points, chosen, projection, splat.reach_px()), chosen.size(), spots_);
  if (pattern == nullptr) {
    return;
  }
  std::erase_if(chosen, [&](std::int32_t number) {
    const Vector3<float>& spikes = points[static_cast<std::size_t>(number)].spikes;
    return !(spikes.x + spikes.y + spikes.z > 0.0F);
  });
  if (chosen.empty()) {
    return;
  }
  if (pattern_there_ != pattern->rgb) {
    reserve(backend_, pattern->rgb.size(), "diffraction pattern, placed", pattern_);
    pattern_.write(pattern->rgb.data(), pattern->rgb.size());
    pattern_there_ = pattern->rgb;
    pattern_px_ = pattern->size_px;
  }
  place(star_tiles(points, chosen, projection, 0.5 * pattern_px_ + 1.0), chosen.size(), spikes_);
}

StarLightBatch TiledStars::batch_of(const Placed& placed) const {
  StarLightBatch batch{};
  batch.projection = converted_projection<float>(projection_);
  const std::vector<PictureSheet> sheets = picture_sheets(projection_);
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    batch.cells[i] = sheets[i].cell;
  }
  batch.points = points_.data();
  batch.tiles = placed.numbers.data();
  batch.first = batch.tiles + placed.tiles;
  batch.members = batch.first + placed.tiles + 1;
  batch.tile_columns = placed.columns;
  batch.count = placed.tiles * star_tile_px * star_tile_px;
  if (splat_.sigma_px > 0.0) {
    // A pixel less than what they may reach: the rest is the pixel that holds the end.
    const double reach = splat_.reach_px() - 1.0;
    const double narrower = 1.0 / (splat_.sigma_px * std::numbers::sqrt2);
    batch.narrower = static_cast<float>(narrower);
    batch.reach_px = static_cast<float>(reach);
    batch.share = static_cast<float>(0.5 / std::erf(reach * narrower));
  }
  return batch;
}

void TiledStars::draw(int first_row, int row_count, float* rgba) const {
  for (const Placed* const placed : {&spots_, &spikes_}) {
    if (placed->tiles == 0) {
      continue;
    }
    StarLightBatch batch = batch_of(*placed);
    batch.rgba = rgba;
    batch.first_row = first_row;
    batch.end_row = first_row + row_count;
    if (placed == &spikes_) {
      batch.pattern = pattern_.data();
      batch.pattern_px = pattern_px_;
    }
    draw_stars(backend_, batch, placed->points);
  }
}

}  // namespace ergodome
