#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "render/patterns/patterns.h"

// Patterns at the resolution of the picture. They show whether single pixels of the master are
// visible: a warp that blurs or shifts by half a pixel turns lines of one pixel into gray.
namespace ergodome {

namespace {

constexpr int wedges = 36;

//! A test patch of `size_px` x `size_px` pixels: a Siemens star, surrounded by fields of lines.
struct Patch {
  int x_px;  //!< position of the center of the patch
  int y_px;
};

int patch_size(const PatternView& projection) {
  return std::clamp(std::min(projection.width_px, projection.height_px) / 12, 24, 384);
}

//! Returns patches spread over the image: on a fisheye at the zenith and on rings halfway out and
//! near the rim, otherwise in rows and columns.
std::vector<Patch> patches(const PatternView& projection) {
  const double width = projection.width_px;
  const double height = projection.height_px;
  std::vector<Patch> all;
  const auto put = [&](double x, double y) {
    all.push_back({static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))});
  };
  if (projection.kind == ProjectionKind::dome_fisheye) {
    put(0.5 * width, 0.5 * height);
    for (const double radius : {0.45, 0.85}) {
      for (int i = 0; i < 8; ++i) {
        put(0.5 * width * (1.0 + radius * std::sin(i * pi / 4.0)),
            0.5 * height * (1.0 + radius * std::cos(i * pi / 4.0)));
      }
    }
    return all;
  }
  const int columns = projection.kind == ProjectionKind::cube ? cube_columns(projection.cube.layout) : 5;
  const int rows = projection.kind == ProjectionKind::cube ? columns == 4 ? 3 : 1 : 3;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      put((column + 0.5) / columns * width, (row + 0.5) / rows * height);
    }
  }
  return all;
}

//! Returns the light of a patch at an offset from the patch's center; negative outside the patch.
float patch_light(double dx, double dy, int size_px) {
  const double half = 0.5 * size_px;
  const double radius = std::hypot(dx, dy);
  if (radius < 0.55 * half) {
    return std::sin(wedges * std::atan2(dy, dx)) >= 0.0 ? 1.0F : 0.0F;
  }
  if (std::abs(dx) >= half || std::abs(dy) >= half || radius < 0.62 * half) {
    return -1.0F;
  }
  // In the corners of the patch: vertical and horizontal lines, above with a width of one pixel,
  // below of two.
  const auto column = static_cast<long>(std::floor(dx));
  const auto row = static_cast<long>(std::floor(dy));
  const long along = dx < 0.0 ? column : row;
  const long width = dy < 0.0 ? 1 : 2;
  const long line = (along + 4L * size_px) / width;
  return line % 2 == 0 ? 1.0F : 0.0F;
}

}  // namespace

Picture resolution_pattern(const PatternView& projection) {
  const int size_px = patch_size(projection);
  const std::vector<Patch> all = patches(projection);
  // Inside this radius, wedges and gaps are less than one pixel wide.
  const double finest_px = wedges * 2.0 / (2.0 * pi);
  return draw_pattern(projection, 4, [&, finest_px](const PatternPosition& position) -> Vector3<float> {
    for (const Patch& patch : all) {
      const double dx = position.x_px - patch.x_px;
      const double dy = position.y_px - patch.y_px;
      const float light = patch_light(dx, dy, size_px);
      if (light < 0.0F) {
        continue;
      }
      for (const double pixels : {1.0, 2.0}) {
        if (std::abs(std::hypot(dx, dy) - pixels * finest_px) < 0.5 && pixels * finest_px < 0.27 * size_px) {
          return {1.0F, 0.3F, 0.0F};
        }
      }
      return {light, light, light};
    }
    return {0.02F, 0.02F, 0.02F};
  });
}

}  // namespace ergodome
