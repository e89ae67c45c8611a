#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/host_device.h"
#include "kernels/core/shared_counter.h"
#include "kernels/core/sort_in_place.h"
#include "kernels/stars/draw_stars.h"

// Assigns points of light to tiles, and adds their light to pixels.
namespace ergodome::inline ERGO_TARGET {

//! Calls body(tile) for each tile that a point's light may reach. In a picture that wraps round the
//! sky, the point is also treated one width to the left and right. Visits only the tile rows of
//! thread `thread`.
template <class Body>
ERGO_HD void for_tiles_about(const StarTileBatch& batch, const StarPoint& point, int thread, const Body& body) {
  const auto between = [](double position, double low, double high) {
    return static_cast<int>(::fmin(::fmax(::floor(position), low), high));
  };
  const int top = between(point.y_px - batch.reach_px, 0.0, batch.height_px);
  const int bottom = between(point.y_px + batch.reach_px, -1.0, batch.height_px - 1);
  const int turns = batch.wraps ? 1 : 0;
  for (int turn = -turns; turn <= turns; ++turn) {
    const double x = point.x_px + turn * batch.width_px;
    const int left = between(x - batch.reach_px, 0.0, batch.width_px);
    const int right = between(x + batch.reach_px, -1.0, batch.width_px - 1);
    if (top > bottom || left > right) {
      continue;
    }
    for (int row = top / star_tile_px + thread; row <= bottom / star_tile_px; row += batch.point_threads) {
      for (int column = left / star_tile_px; column <= right / star_tile_px; ++column) {
        body(row * batch.columns + column);
      }
    }
  }
}

//! Counts a point in the tiles that its light may reach or, if `Lists`, adds it to the lists of
//! these tiles.
template <bool Lists>
struct PlaceStar {
  StarTileBatch batch;

  ERGO_HD void operator()(int index) const {
    const StarPoint& point = batch.points[index / batch.point_threads];
    if (batch.spikes_alone && !(point.spikes.x + point.spikes.y + point.spikes.z > 0.0F)) {
      return;
    }
    for_tiles_about(batch, point, index % batch.point_threads, [&](int tile) {
      const std::int32_t before = count_up(batch.counts + tile);
      if constexpr (Lists) {
        batch.members[batch.first[tile] + before] = index / batch.point_threads;
      }
    });
  }
};

//! Sorts a tile's points by number, since threads list them in nondeterministic order. Most tiles
//! have few.
struct SortTile {
  StarTileBatch batch;

  ERGO_HD void operator()(int tile) const {
    std::int32_t* const list = batch.members + batch.first[tile];
    const int count = batch.first[tile + 1] - batch.first[tile];
    sort_in_place(list, count, [](std::int32_t a, std::int32_t b) { return a < b; });
  }
};

//! Adds the light of stars to pixel i of the rows.
struct DrawStars {
  StarLightBatch batch;

  ERGO_HD void operator()(int index) const {
    const int width = batch.projection.width_px;
    const int row = index / width;
    const int x = index - row * width;
    const int y = batch.first_row + row;
    const int tile = y / star_tile_px * batch.tile_columns + x / star_tile_px;
    const int first = batch.first[tile];
    const int last = batch.first[tile + 1];
    if (first == last) {
      return;
    }
    float light[3] = {};
    for (int i = first; i < last; ++i) {
      if (!counts_again(first, i)) {
        add(batch.points[batch.members[i]], x, y, light);
      }
    }
    lay(light, x, y);
  }

  //! Returns whether `member` repeats the previous point of the tile whose list begins at `first`.
  [[nodiscard]] ERGO_HD bool counts_again(int first, int member) const {
    return member > first && batch.members[member] == batch.members[member - 1];
  }

  //! Adds light to the picture.
  ERGO_HD void lay(const float (&light)[3], int x, int y) const {
    const float covered = image_coverage(batch.projection, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    // Spikes are cut off at the image's edge; points fade with the pixel's coverage.
    const float inside = batch.pattern == nullptr ? covered : covered > 0.0F ? 1.0F : 0.0F;
    float* const to = batch.rgba + 4 * (static_cast<long>(y - batch.first_row) * batch.projection.width_px + x);
    for (int channel = 0; channel < 3; ++channel) {
      to[channel] += inside * light[channel];
    }
  }

  //! Returns the fraction of a point's light that falls on pixel column x; 0 outside the point's
  //! region. A pixel receives the product of its column's and its row's fractions.
  [[nodiscard]] ERGO_HD float part_of_column(const StarPoint& point, int x) const {
    const PixelCell& cell = batch.cells[point.region];
    if (x < cell.left_px || x >= cell.left_px + cell.width_px) {
      return 0.0F;
    }
    const int turns = wraps_around(batch.projection) ? 1 : 0;
    float part = 0.0F;
    for (int turn = -turns; turn <= turns; ++turn) {
      part += part_of(x + turn * batch.projection.width_px, point.x_px);
    }
    return part;
  }

  [[nodiscard]] ERGO_HD float part_of_row(const StarPoint& point, int y) const {
    const PixelCell& cell = batch.cells[point.region];
    return y < cell.top_px || y >= cell.top_px + cell.height_px ? 0.0F : part_of(y, point.y_px);
  }

  //! Adds the light of a point that falls on a pixel.
  ERGO_HD void add(const StarPoint& point, int x, int y, float (&light)[3]) const {
    if (batch.pattern == nullptr) {
      const float part = part_of_column(point, x) * part_of_row(point, y);
      light[0] += part * point.light.x;
      light[1] += part * point.light.y;
      light[2] += part * point.light.z;
      return;
    }
    const PixelCell& cell = batch.cells[point.region];
    if (x < cell.left_px || x >= cell.left_px + cell.width_px || y < cell.top_px || y >= cell.top_px + cell.height_px) {
      return;
    }
    const int turns = wraps_around(batch.projection) ? 1 : 0;
    for (int turn = -turns; turn <= turns; ++turn) {
      const int column = x + turn * batch.projection.width_px;
      const float half = 0.5F * static_cast<float>(batch.pattern_px);
      const Vector3<float> pattern =
          pattern_at(static_cast<float>(column - point.x_px) + half, static_cast<float>(y - point.y_px) + half);
      light[0] += pattern.x * point.spikes.x;
      light[1] += pattern.y * point.spikes.y;
      light[2] += pattern.z * point.spikes.z;
    }
  }

 private:
  //! Returns the fraction of light centered at `middle` that falls on the pixel [at, at + 1].
  [[nodiscard]] ERGO_HD float part_of(int at, double middle) const {
    if (!(batch.narrower > 0.0F)) {
      return ::floor(middle) == at ? 1.0F : 0.0F;
    }
    const auto x = static_cast<float>(at - middle);
    const float from = minimum(maximum(x, -batch.reach_px), batch.reach_px);
    const float to = minimum(maximum(x + 1.0F, -batch.reach_px), batch.reach_px);
    return from < to ? batch.share * (erff(to * batch.narrower) - erff(from * batch.narrower)) : 0.0F;
  }

  //! Returns the light of the spike pattern at offset (x, y) from its first pixel, interpolated
  //! bilinearly.
  [[nodiscard]] ERGO_HD Vector3<float> pattern_at(float x, float y) const {
    const float left = floorf(x);
    const float top = floorf(y);
    Vector3<float> sum{};
    for (int corner = 0; corner < 4; ++corner) {
      const float across = left + static_cast<float>(corner % 2);
      const int row = corner / 2;
      const float down = top + static_cast<float>(row);
      const float part = (1.0F - fabsf(x - across)) * (1.0F - fabsf(y - down));
      const auto size = static_cast<float>(batch.pattern_px);
      if (across >= 0.0F && across < size && down >= 0.0F && down < size) {
        const float* const from =
            batch.pattern + 3 * (static_cast<long>(down) * batch.pattern_px + static_cast<long>(across));
        sum = sum + part * Vector3<float>{from[0], from[1], from[2]};
      }
    }
    return sum;
  }
};

template <class T, class Action>
void dispatch(const StarTileBatch& batch, const Action& action) {
  switch (batch.step) {
    case StarTileStep::count:
      return action(PlaceStar<false>{batch});
    case StarTileStep::list:
      return action(PlaceStar<true>{batch});
    case StarTileStep::sort:
      break;
  }
  action(SortTile{batch});
}

template <class T, class Action>
void dispatch(const StarLightBatch& batch, const Action& action) {
  action(DrawStars{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
