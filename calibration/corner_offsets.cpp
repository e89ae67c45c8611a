#include "calibration/corner_offsets.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Between the four corners' values.
double between(const std::array<double, 4>& corner, const RasterPlace& place) {
  return std::lerp(std::lerp(corner[0], corner[1], place.x), std::lerp(corner[3], corner[2], place.x), place.y);
}

//! A channel of a mask between its samples, which fill the raster.
float read(const BlendMap& mask, const RasterPlace& place, int channel) {
  const double x = std::clamp(place.x * mask.width - 0.5, 0.0, mask.width - 1.0);
  const double y = std::clamp(place.y * mask.height - 0.5, 0.0, mask.height - 1.0);
  const int left = std::min(static_cast<int>(x), mask.width - 2);
  const int top = std::min(static_cast<int>(y), mask.height - 2);
  const auto at = [&](int column, int row) {
    const std::size_t pixel =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(column);
    return static_cast<double>(
        mask.values[static_cast<std::size_t>(mask.channels) * pixel + static_cast<std::size_t>(channel)]);
  };
  return static_cast<float>(std::lerp(std::lerp(at(left, top), at(left + 1, top), x - left),
                                      std::lerp(at(left, top + 1), at(left + 1, top + 1), x - left), y - top));
}

}  // namespace

RasterPlace moved_place(const CornerOffsets& corners, const RasterPlace& place) {
  return {place.x + between(corners.right, place), place.y + between(corners.down, place)};
}

RasterPlace moved_back(const CornerOffsets& corners, const RasterPlace& place) {
  // Newton's method with differences; the map is bilinear and close to the identity.
  constexpr double step = 1e-6;
  RasterPlace back = place;
  for (int round = 0; round < 20; ++round) {
    const RasterPlace at = moved_place(corners, back);
    const double miss_x = place.x - at.x;
    const double miss_y = place.y - at.y;
    if (std::hypot(miss_x, miss_y) < 1e-12) {
      break;
    }
    const RasterPlace aside = moved_place(corners, {back.x + step, back.y});
    const RasterPlace below = moved_place(corners, {back.x, back.y + step});
    const double xx = (aside.x - at.x) / step;
    const double yx = (aside.y - at.y) / step;
    const double xy = (below.x - at.x) / step;
    const double yy = (below.y - at.y) / step;
    const double area = xx * yy - xy * yx;
    back.x += (yy * miss_x - xy * miss_y) / area;
    back.y += (xx * miss_y - yx * miss_x) / area;
  }
  return back;
}

WarpMesh moved_warp(const CornerOffsets& corners, const WarpMesh& mesh) {
  WarpMesh shifted = mesh;
  for (WarpNode& node : shifted.nodes) {
    const RasterPlace place = moved_place(corners, RasterPlace{node.x, node.y});
    node.x = static_cast<float>(place.x);
    node.y = static_cast<float>(place.y);
  }
  return shifted;
}

BlendMap moved_mask(const CornerOffsets& corners, const BlendMap& mask) {
  BlendMap shifted = mask;
  std::size_t value = 0;
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column) {
      const RasterPlace from =
          moved_back(corners, {fill_position(column, mask.width), fill_position(row, mask.height)});
      for (int channel = 0; channel < mask.channels; ++channel) {
        shifted.values[value++] = read(mask, from, channel);
      }
    }
  }
  return shifted;
}

}  // namespace ergodome
