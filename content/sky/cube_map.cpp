#include "content/sky/cube_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! A direction in the axes of a viewer inside the cube.
struct ViewDirection {
  double right, up, forward;
};

//! A position in a cube map: the cell of the face in the image, and the position in it, 0 to 1 from
//! its top left corner.
struct FacePosition {
  int column, row;
  double s, t;
};

enum Face { right_face, left_face, top_face, bottom_face, front_face, back_face };

struct FacePoint {
  Face face;
  double s, t;
};

//! Returns the face that a direction meets, and the position on it; right, up and forward are X, Y
//! and Z of OpenGL.
FacePoint face_point(const ViewDirection& d) {
  const double x = std::abs(d.right);
  const double y = std::abs(d.up);
  const double z = std::abs(d.forward);
  const auto point = [](Face face, double s, double t, double major) {
    return FacePoint{face, 0.5 * (s / major + 1.0), 0.5 * (t / major + 1.0)};
  };
  if (x >= y && x >= z) {
    return d.right > 0.0 ? point(right_face, -d.forward, -d.up, x) : point(left_face, d.forward, -d.up, x);
  }
  if (y >= z) {
    return d.up > 0.0 ? point(top_face, d.right, d.forward, y) : point(bottom_face, d.right, -d.forward, y);
  }
  return d.forward > 0.0 ? point(front_face, d.right, -d.up, z) : point(back_face, -d.right, -d.up, z);
}

FacePosition position_in_cross(const FacePoint& point, bool vertical) {
  switch (point.face) {
    case right_face:
      return {2, 1, point.s, point.t};
    case left_face:
      return {0, 1, point.s, point.t};
    case top_face:
      return {1, 0, point.s, point.t};
    case bottom_face:
      return {1, 2, point.s, point.t};
    case front_face:
      return {1, 1, point.s, point.t};
    case back_face:
      break;
  }
  return vertical ? FacePosition{1, 3, 1.0 - point.s, 1.0 - point.t} : FacePosition{3, 1, point.s, point.t};
}

//! Converts a position on a face to OpenEXR's layout, whose X axis points to the left of a viewer
//! facing along Z, and whose top and bottom faces are turned by 180°.
FacePosition position_in_openexr(const FacePoint& point) {
  switch (point.face) {
    case left_face:  // +X
      return {0, 0, point.s, point.t};
    case right_face:  // -X
      return {0, 1, point.s, point.t};
    case top_face:
      return {0, 2, 1.0 - point.s, 1.0 - point.t};
    case bottom_face:
      return {0, 3, 1.0 - point.s, 1.0 - point.t};
    case front_face:
      return {0, 4, point.s, point.t};
    case back_face:
      break;
  }
  return {0, 5, point.s, point.t};
}

FacePosition face_position(const ViewDirection& direction, CubeMapLayout layout) {
  const FacePoint point = face_point(direction);
  switch (layout) {
    case CubeMapLayout::row:
      return {point.face, 0, point.s, point.t};
    case CubeMapLayout::column:
      return {0, point.face, point.s, point.t};
    case CubeMapLayout::openexr:
      return position_in_openexr(point);
    case CubeMapLayout::horizontal_cross:
    case CubeMapLayout::vertical_cross:
      break;
  }
  return position_in_cross(point, layout == CubeMapLayout::vertical_cross);
}

//! Adds the bilinear color at a position to `to`; beyond the edge of the face, edge texels are
//! repeated.
void put_color(const EnvironmentImage& cube, int side, const FacePosition& at, float* to) {
  const auto corner = [&](double part) { return std::clamp(part * side - 0.5, 0.0, side - 1.0); };
  const double x = corner(at.s);
  const double y = corner(at.t);
  const int left = std::min(static_cast<int>(x), std::max(side - 2, 0));
  const int top = std::min(static_cast<int>(y), std::max(side - 2, 0));
  const auto across = static_cast<float>(x - left);
  const auto down = static_cast<float>(y - top);
  const float weights[4] = {(1.0F - across) * (1.0F - down), across * (1.0F - down), (1.0F - across) * down,
                            across * down};
  for (int i = 0; i < 4; ++i) {
    const int column = at.column * side + std::min(left + i % 2, side - 1);
    const int row = at.row * side + std::min(top + i / 2, side - 1);
    const float* const texel = cube.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(row) * cube.width + column);
    for (int c = 0; c < 3; ++c) {
      to[c] += weights[i] * texel[c];
    }
  }
}

//! Returns true if a cell of a cross has a single color, except within an eighth of its width from
//! its edges.
bool is_plain_cell(const EnvironmentImage& image, int side, int column, int row) {
  constexpr float tolerance = 0.02F;
  const int margin = std::min(side / 8 + 1, side / 2);
  float minimum[3] = {1e30F, 1e30F, 1e30F};
  float maximum[3] = {-1e30F, -1e30F, -1e30F};
  for (int y = row * side + margin; y < (row + 1) * side - margin; ++y) {
    for (int x = column * side + margin; x < (column + 1) * side - margin; ++x) {
      const float* const texel = image.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * image.width + x);
      for (int c = 0; c < 3; ++c) {
        minimum[c] = std::min(minimum[c], texel[c]);
        maximum[c] = std::max(maximum[c], texel[c]);
      }
    }
  }
  for (int c = 0; c < 3; ++c) {
    if (maximum[c] - minimum[c] > tolerance) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::array<int, 2> faces_of(CubeMapLayout layout) {
  switch (layout) {
    case CubeMapLayout::row:
      return {6, 1};
    case CubeMapLayout::horizontal_cross:
      return {4, 3};
    case CubeMapLayout::vertical_cross:
      return {3, 4};
    case CubeMapLayout::column:
    case CubeMapLayout::openexr:
      break;
  }
  return {1, 6};
}

std::optional<CubeMapLayout> cube_map_layout(int width, int height, bool openexr_cube) {
  if (openexr_cube) {
    return height == 6L * width ? std::optional(CubeMapLayout::openexr) : std::nullopt;
  }
  for (const CubeMapLayout layout :
       {CubeMapLayout::row, CubeMapLayout::column, CubeMapLayout::horizontal_cross, CubeMapLayout::vertical_cross}) {
    const auto [columns, rows] = faces_of(layout);
    if (width % columns == 0 && height % rows == 0 && width / columns == height / rows) {
      return layout;
    }
  }
  return std::nullopt;
}

bool has_plain_corners(const EnvironmentImage& image, CubeMapLayout layout) {
  const bool vertical = layout == CubeMapLayout::vertical_cross;
  if (!vertical && layout != CubeMapLayout::horizontal_cross) {
    return true;
  }
  const auto [columns, rows] = faces_of(layout);
  const int side = image.width / columns;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (row != 1 && column != 1 && !is_plain_cell(image, side, column, row)) {
        return false;
      }
    }
  }
  return true;
}

EnvironmentImage equirectangular_from_cube(const EnvironmentImage& cube, CubeMapLayout layout, int width) {
  const int side = cube.width / faces_of(layout)[0];
  EnvironmentImage image;
  image.name = cube.name;
  image.width = width;
  image.height = width / 2;
  image.file_width = cube.file_width;
  image.repaired = cube.repaired;
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  parallel_for(image.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const double latitude = pi * (0.5 - (y + 0.5) / image.height);
      float* to = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(y) * image.width;
      for (int x = 0; x < image.width; ++x, to += 3) {
        const double longitude = 2.0 * pi * ((x + 0.5) / image.width - 0.5);
        const ViewDirection direction = {std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                                         std::cos(latitude) * std::cos(longitude)};
        put_color(cube, side, face_position(direction, layout), to);
      }
    }
  });
  return image;
}

}  // namespace ergodome
