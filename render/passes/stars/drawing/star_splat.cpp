#include "render/passes/stars/drawing/star_splat.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/quad.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/stars/drawing/picture_regions.h"
#include "render/passes/stars/drawing/point_spread.h"

namespace ergodome {

namespace {

constexpr double cut_off_sigmas = 3.0;
constexpr int splat_band_rows = 32;

double row_of(const StarPoint& point) { return std::floor(point.y_px); }

//! Returns whether all pixels of a rectangle are entirely inside the image, which follows from its
//! corners; false for cubes, for which it does not.
bool is_all_inside(const Projection& projection, int left, int right, int top, int bottom) {
  const auto inside = [&](int x, int y) { return image_coverage(projection, x + 0.5, y + 0.5) >= 1.0; };
  return projection.kind != ProjectionKind::cube && inside(left, top) && inside(right, top) && inside(left, bottom) &&
         inside(right, bottom);
}

//! Adds a row of pixels that are entirely inside the image. `light`: light of the row; its fourth
//! channel is 0.
void add_whole_row(const PointSpread& across, const Quad& light, float* rgba) {
  for (int i = 0; i < across.count; ++i) {
    float* const pixel = rgba + 4 * i;
    store_quad(pixel, load_quad(pixel) + across.part[static_cast<std::size_t>(i)] * light);
  }
}

//! Adds the light of one point to those pixels that are in rows [top, bottom) and in a cell of the
//! picture. `rgba` begins at row `origin`.
void add(const StarPoint& splat, const Projection& projection, const PixelCell& cell, const PointSpreads& spreads,
         int top, int bottom, int origin, float* rgba) {
  PointSpread across;
  PointSpread down;
  spreads.spread(splat.x_px, across);
  spreads.spread(splat.y_px, down);
  const bool wraps = wraps_around(projection);
  const int width = projection.width_px;
  const int first_row = std::max(top, cell.top_px);
  const int end_row = std::min(bottom, cell.top_px + cell.height_px);
  const bool all_inside =
      is_all_inside(projection, across.first, across.first + across.count - 1, down.first, down.first + down.count - 1);
  const bool whole_rows =
      all_inside && across.first >= cell.left_px && across.first + across.count <= cell.left_px + cell.width_px;
  for (int j = 0; j < down.count; ++j) {
    const int y = down.first + j;
    if (y < first_row || y >= end_row) {
      continue;
    }
    if (whole_rows) {
      const float part = down.part[static_cast<std::size_t>(j)];
      add_whole_row(across, part * quad_from(splat.light.x, splat.light.y, splat.light.z, 0.0F),
                    rgba + 4 * (static_cast<std::ptrdiff_t>(y - origin) * width + across.first));
      continue;
    }
    for (int i = 0; i < across.count; ++i) {
      int x = across.first + i;
      x = wraps ? ((x % width) + width) % width : x;
      if (x < cell.left_px || x >= cell.left_px + cell.width_px) {
        continue;
      }
      const double inside = all_inside ? 1.0 : image_coverage(projection, x + 0.5, y + 0.5);
      const float part = across.part[static_cast<std::size_t>(i)] * down.part[static_cast<std::size_t>(j)] *
                         static_cast<float>(inside);
      float* to = rgba + 4 * (static_cast<std::size_t>(y - origin) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
      to[0] += part * splat.light.x;
      to[1] += part * splat.light.y;
      to[2] += part * splat.light.z;
    }
  }
}

}  // namespace

double SplatSettings::reach_px() const {
  return std::min(cutoff_px > 0.0 ? cutoff_px : cut_off_sigmas * sigma_px, widest_splat_px - 1.0) + 1.0;
}

SplatSettings scaled_to(const SplatSettings& settings, const Projection& projection) {
  constexpr double pixel_of_4k = 3.14159265358979323846 / 4096;
  SplatSettings scaled = settings;
  if (projection.kind != ProjectionKind::pinhole) {
    const double maximum = (widest_splat_px - 1.0) / std::max(settings.reach_px() - 1.0, 1.0);
    const double scale = std::clamp(pixel_of_4k / pixel_angle(projection), 1.0, std::max(maximum, 1.0));
    scaled.sigma_px *= scale;
    scaled.cutoff_px *= scale;
  }
  return scaled;
}

void splat_points(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& settings,
                  int first_row, int row_count, float* rgba) {
  static WorkCounter counter("splat_stars");
  const WorkScope work(counter, static_cast<long>(points.size()));
  const std::vector<PictureRegion> regions = picture_regions(projection);
  const double reach = settings.reach_px();
  const PointSpreads spreads(settings.sigma_px, reach - 1.0);
  const int bands = (row_count + splat_band_rows - 1) / splat_band_rows;
  parallel_for(bands, 1, [&](int begin, int end) {
    const int top = first_row + begin * splat_band_rows;
    const int bottom = std::min(first_row + end * splat_band_rows, first_row + row_count);
    auto point = std::ranges::lower_bound(points, std::floor(top - reach), {}, row_of);
    for (; point != points.end() && row_of(*point) < bottom + reach; ++point) {
      add(*point, projection, regions[static_cast<std::size_t>(point->region)].cell, spreads, top, bottom, first_row,
          rgba);
    }
  });
}

}  // namespace ergodome
