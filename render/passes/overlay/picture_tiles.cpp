#include "render/passes/overlay/picture_tiles.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Maximum half angle of a tile's cone. A tile with a wider cone extends across a seam or is in a
//! coarse picture, and is assumed to contain all directions.
constexpr double widest_cone = 1.0;
//! Factor on the half angle of a cone, for directions between the sampled ones.
constexpr double cone_slack = 1.2;
constexpr float everywhere = 4.0F;

bool same_direction(const Vector3<double>& a, const Vector3<double>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace

PictureTiles::PictureTiles(const Projection& projection)
    : projection_(projection),
      columns_((projection.width_px + overlay_tile_px - 1) / overlay_tile_px),
      rows_((projection.height_px + overlay_tile_px - 1) / overlay_tile_px),
      cones_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  parallel_for(rows_, 2, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < columns_; ++column) {
        cones_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)] =
            cone_of(column, row);
      }
    }
  });
}

PictureTiles::Cone PictureTiles::cone_of(int column, int row) const {
  // Samples from the centers of the tile's first pixels to those of its last. Cube faces are larger
  // than a tile, so each face that a tile overlaps contains one of the tile's corners.
  const double left = column * overlay_tile_px + 0.5;
  const double top = row * overlay_tile_px + 0.5;
  const double right = std::min(left + overlay_tile_px, static_cast<double>(projection_.width_px)) - 0.5;
  const double bottom = std::min(top + overlay_tile_px, static_cast<double>(projection_.height_px)) - 0.5;
  const Vector3<double> axis = direction_from_pixel(projection_, 0.5 * (left + right), 0.5 * (top + bottom));
  double min_cosine = 1.0;
  for (const double x : {left, 0.5 * (left + right), right}) {
    for (const double y : {top, 0.5 * (top + bottom), bottom}) {
      min_cosine = std::min(min_cosine, dot(axis, direction_from_pixel(projection_, x, y)));
    }
  }
  const double angle = std::acos(std::clamp(min_cosine, -1.0, 1.0));
  return {{static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)},
          angle < widest_cone ? static_cast<float>(cone_slack * angle) : everywhere};
}

bool PictureTiles::are_of(const Projection& projection) const {
  if (projection.kind != projection_.kind || projection.width_px != projection_.width_px ||
      projection.height_px != projection_.height_px) {
    return false;
  }
  // Projections that agree bit for bit at these positions are considered equal.
  for (const double part : {0.03, 0.31, 0.5, 0.77}) {
    const double x = part * projection.width_px;
    const double y = (part + 0.05) * projection.height_px;
    if (!same_direction(direction_from_pixel(projection, x, y), direction_from_pixel(projection_, x, y))) {
      return false;
    }
  }
  return true;
}

std::vector<std::int32_t> PictureTiles::within(const OverlaySurface& surface) const {
  const float bound = std::acos(std::clamp(surface.bound_cosine, -1.0F, 1.0F));
  std::vector<std::int32_t> tiles;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& cone = cones_[i];
    const float apart = std::acos(std::clamp(dot(cone.axis, surface.bound_axis), -1.0F, 1.0F));
    if (apart <= bound + cone.half_angle + 1e-3F) {
      tiles.push_back(static_cast<std::int32_t>(i));
    }
  }
  return tiles;
}

}  // namespace ergodome
