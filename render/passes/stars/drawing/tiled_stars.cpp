#include "render/passes/stars/drawing/tiled_stars.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/core/error.h"
#include "kernels/launch/launch.h"
#include "render/passes/stars/drawing/picture_regions.h"

namespace ergodome {

namespace {

//! Number of threads that share the tiles of a point with spikes, row by row.
constexpr int threads_of_spikes = 16;

//! Throws Error with a remedy if `members`, a number of (point, tile) pairs, exceeds `maximum`.
void require_listable(double members, double maximum, const char* remedy) {
  if (members > maximum) {
    throw Error("stars", "cover more pixels than the GPU can list",
                std::string(remedy) + ", or run with --backend cpu");
  }
}

//! Returns an upper bound of the number of (point, tile) pairs. The kernels count them in 32 bits.
double max_members(int points, double reach_px) {
  const double across = 2.0 * reach_px / star_tile_px + 2.0;
  return points * across * across;
}

//! Maximum number of pairs that can be counted, and maximum number that can be listed (1 GB).
constexpr double max_counted = 2e9;
constexpr double max_listed = 2.5e8;

constexpr const char* fewer_spots =
    "choose a smaller effects.psf.sigma_px or cutoff_px, or show fewer faint stars (sky.faintest_mag)";
constexpr const char* fewer_spikes = "give fewer stars spikes (effects.diffraction.brighter_than_mag)";

}  // namespace

void TiledStars::place(double reach_px, bool spikes_alone, Placed& placed) const {
  const int rows = (projection_.height_px + star_tile_px - 1) / star_tile_px;
  const int tiles = columns() * rows;
  const auto count = static_cast<std::size_t>(tiles);
  reserve(backend_, count, "star tiles", placed.counts);
  reserve(backend_, count + 1, "star tiles", placed.first);
  StarTileBatch batch{points_.points,
                      points_.count,
                      spikes_alone ? threads_of_spikes : 1,
                      spikes_alone,
                      reach_px,
                      projection_.width_px,
                      projection_.height_px,
                      wraps_around(projection_),
                      columns(),
                      tiles,
                      placed.counts.data(),
                      placed.first.data(),
                      nullptr};
  clear(backend_, placed.counts, count);
  launch(backend_, batch);
  sum_counts(backend_, placed.counts.data(), tiles, placed.first.data());
  std::int32_t members = 0;
  copy_to_host(backend_, &members, placed.first.data() + tiles, 1);
  require_listable(members, max_listed, spikes_alone ? fewer_spikes : fewer_spots);
  placed.members = members;
  if (members == 0) {
    return;
  }
  reserve(backend_, static_cast<std::size_t>(members), "star tiles", placed.numbers);
  batch.members = placed.numbers.data();
  clear(backend_, placed.counts, count);
  batch.step = StarTileStep::list;
  launch(backend_, batch);
  batch.step = StarTileStep::sort;
  launch(backend_, batch);
}

void TiledStars::set_pattern(const DiffractionPattern& pattern) {
  if (pattern_there_ == pattern.rgb) {
    return;
  }
  reserve(backend_, pattern.rgb.size(), "diffraction pattern, placed", pattern_);
  pattern_.write(pattern.rgb.data(), pattern.rgb.size());
  pattern_there_ = pattern.rgb;
  pattern_px_ = pattern.size_px;
}

void TiledStars::set(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& splat,
                     const DiffractionPattern* pattern) {
  const auto has_spikes = [](const StarPoint& p) { return p.spikes.x + p.spikes.y + p.spikes.z > 0.0F; };
  const auto spiked = pattern != nullptr ? std::ranges::count_if(points, has_spikes) : 0;
  reserve(backend_, points.size(), "star points", own_points_);
  own_points_.write(points.data(), points.size());
  set(PlacedPoints{own_points_.data(), static_cast<int>(points.size()), static_cast<int>(spiked)}, projection, splat,
      pattern);
}

void TiledStars::set(const PlacedPoints& points, const Projection& projection, const SplatSettings& splat,
                     const DiffractionPattern* pattern) {
  const DeviceWorkInOrder in_order(backend_);
  projection_ = projection;
  splat_ = splat;
  points_ = points;
  spots_.members = 0;
  spikes_.members = 0;
  if (points.count == 0) {
    return;
  }
  require_listable(max_members(points.count, splat.reach_px()), max_counted, fewer_spots);
  place(splat.reach_px(), false, spots_);
  if (pattern != nullptr && points.spiked > 0) {
    set_pattern(*pattern);
    const double reach_px = 0.5 * pattern_px_ + 1.0;
    require_listable(max_members(points.spiked, reach_px), max_counted, fewer_spikes);
    place(reach_px, true, spikes_);
  }
}

StarLightBatch TiledStars::batch_of(const Placed& placed) const {
  StarLightBatch batch{};
  batch.projection = converted_projection<float>(projection_);
  const std::vector<PictureRegion> regions = picture_regions(projection_);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    batch.cells[i] = regions[i].cell;
  }
  batch.points = points_.points;
  batch.point_count = points_.count;
  batch.first = placed.first.data();
  batch.members = placed.numbers.data();
  batch.tile_columns = columns();
  if (splat_.sigma_px > 0.0) {
    // Uses one pixel less than reach_px(), which includes the pixel that contains the end of the
    // Gaussian.
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
    if (placed->members == 0) {
      continue;
    }
    StarLightBatch batch = batch_of(*placed);
    batch.rgba = rgba;
    batch.first_row = first_row;
    batch.row_count = row_count;
    if (placed == &spikes_) {
      batch.pattern = pattern_.data();
      batch.pattern_px = pattern_px_;
    }
    launch(backend_, batch);
  }
}

}  // namespace ergodome
