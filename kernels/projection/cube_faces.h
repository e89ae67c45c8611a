#pragma once

#include <cstdint>

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// The cube about the viewer: six flat pictures of 90° each, as seen from inside.
//
// Names, order and orientation are those of OpenGL (OpenGL 4.6 core, 8.13, table 8.19) with X to
// the right, Y up and Z forward: px right, nx left, py top, ny bottom, pz front, nz back. The walls
// are upright; the top has the front at its lower side, the bottom at its upper side. Row 0 is the
// top row. The strip has the faces side by side in that order; the cross is 4 wide and 3 high:
//     .  py .  .
//     nx pz px nz
//     .  ny .  .
namespace ergodome {

enum class CubeFace : std::int32_t { right, left, top, bottom, front, back };
inline constexpr int cube_faces = 6;

enum class CubeLayout : std::int32_t { cross, strip, face };

//! Parameters of a picture of a cube.
struct CubePicture {
  CubeLayout layout;
  CubeFace face;  //!< the only face in CubeLayout::face
};

//! Column and row of a face in a layout, counted from the left and from the top.
struct CubeCell {
  int column;
  int row;
};

inline namespace ERGO_TARGET {

ERGO_HD int cube_columns(CubeLayout layout) {
  return layout == CubeLayout::cross ? 4 : (layout == CubeLayout::strip ? 6 : 1);
}
ERGO_HD int cube_rows(CubeLayout layout) { return layout == CubeLayout::cross ? 3 : 1; }

ERGO_HD CubeCell cube_cell(CubeLayout layout, CubeFace face) {
  if (layout == CubeLayout::face) {
    return {0, 0};
  }
  if (layout == CubeLayout::strip) {
    return {static_cast<int>(face), 0};
  }
  switch (face) {
    case CubeFace::right:
      return {2, 1};
    case CubeFace::left:
      return {0, 1};
    case CubeFace::top:
      return {1, 0};
    case CubeFace::bottom:
      return {1, 2};
    case CubeFace::front:
      return {1, 1};
    case CubeFace::back:
      break;
  }
  return {3, 1};
}

//! Returns the integer part of a number, clamped to [0, cells - 1]; at a border between cells,
//! either cell.
template <class R>
ERGO_HD R cell_of(const R& position, int cells) {
  using S = ScalarOf<R>;
  return minimum(maximum(round_to_nearest(position - S(0.5)), R(S(0))), R(static_cast<S>(cells - 1)));
}

//! Returns the number of the face in a cell of a layout; the empty cells of the cross count as top
//! and bottom faces.
template <class R>
ERGO_HD R face_number(const CubePicture& cube, const R& column, const R& row) {
  using S = ScalarOf<R>;
  if (cube.layout == CubeLayout::face) {
    return R(static_cast<S>(static_cast<int>(cube.face)));
  }
  if (cube.layout == CubeLayout::strip) {
    return column;
  }
  const R wall = select(column < R(S(0.5)), R(S(1)),
                        select(column < R(S(1.5)), R(S(4)), select(column < R(S(2.5)), R(S(0)), R(S(5)))));
  return select(row < R(S(0.5)), R(S(2)), select(row > R(S(1.5)), R(S(3)), wall));
}

//! Returns the view direction (x right, y up, z back; unit length) at a position on the faces of
//! the given numbers: a to the right, b up, -1 to 1 across each. Beyond that range, positions
//! continue on the plane of the face.
template <class T>
ERGO_HD Vector3<T> direction_from_face(const RealOf<T>& number, const T& a, const T& b) {
  using R = RealOf<T>;
  using S = ScalarOf<T>;
  const auto is_right = number < R(S(0.5));
  const auto is_wall = (number < R(S(1.5))) | (number > R(S(3.5)));
  const auto is_side = number < R(S(1.5));
  const auto is_turned = ((number > R(S(0.5))) & is_side) | (number > R(S(4.5)));
  const auto is_far = is_right | ((number > R(S(1.5))) & (number < R(S(2.5)))) | (number > R(S(4.5)));
  // Right, top and back are on the positive sides of the axes.
  const T one = select(is_far, T(S(1)), T(S(-1)));
  const T turned = select(is_turned, -a, a);
  const T x = select(is_side, one, turned);
  const T y = select(is_wall, b, one);
  const T upright = select(is_far, b, -b);
  const T z = select(is_side, turned, select(is_wall, one, upright));
  const T inverse_length = S(1) / sqrt(a * a + b * b + S(1));
  return {x * inverse_length, y * inverse_length, z * inverse_length};
}

//! Returns the view direction (unit length) at image position (x, y), -1 to 1 across width and
//! height, y up.
template <class T>
ERGO_HD Vector3<T> direction_from_cube(const CubePicture& cube, const T& x, const T& y) {
  using R = RealOf<T>;
  using S = ScalarOf<T>;
  const int columns = cube_columns(cube.layout);
  const int rows = cube_rows(cube.layout);
  const T across = (x + S(1)) * (S(0.5) * static_cast<S>(columns));
  const T down = (S(1) - y) * (S(0.5) * static_cast<S>(rows));
  const R column = cell_of(value_of(across), columns);
  const R row = cell_of(value_of(down), rows);
  return direction_from_face(face_number(cube, column, row), (across - column) * S(2) - S(1),
                             S(1) - (down - row) * S(2));
}

//! Returns the face that a direction passes through.
ERGO_HD CubeFace face_of(const Vector3<double>& view) {
  const double x = ::fabs(view.x);
  const double y = ::fabs(view.y);
  const double z = ::fabs(view.z);
  if (x > y && x > z) {
    return view.x > 0.0 ? CubeFace::right : CubeFace::left;
  }
  if (y > z) {
    return view.y > 0.0 ? CubeFace::top : CubeFace::bottom;
  }
  return view.z < 0.0 ? CubeFace::front : CubeFace::back;
}

//! Computes the position of a direction on the plane of a face: the inverse of
//! direction_from_face(). Returns false for directions that do not meet the plane.
ERGO_HD bool face_from_direction(CubeFace face, const Vector3<double>& view, double& a, double& b) {
  double ahead = 0.0;
  switch (face) {
    case CubeFace::right:
    case CubeFace::left:
      ahead = face == CubeFace::right ? view.x : -view.x;
      a = face == CubeFace::right ? view.z : -view.z;
      b = view.y;
      break;
    case CubeFace::top:
    case CubeFace::bottom:
      ahead = face == CubeFace::top ? view.y : -view.y;
      a = view.x;
      b = face == CubeFace::top ? view.z : -view.z;
      break;
    case CubeFace::front:
    case CubeFace::back:
      ahead = face == CubeFace::front ? -view.z : view.z;
      a = face == CubeFace::front ? view.x : -view.x;
      b = view.y;
      break;
  }
  if (!(ahead > 0.0)) {
    return false;
  }
  a /= ahead;
  b /= ahead;
  return true;
}

//! Computes the image position of a view direction: the inverse of direction_from_cube(). A single
//! face is extended to its plane, so x and y may be outside [-1, 1]; returns false for directions
//! that do not meet the plane.
ERGO_HD bool cube_from_direction(const CubePicture& cube, const Vector3<double>& view, double& x, double& y) {
  const CubeFace face = cube.layout == CubeLayout::face ? cube.face : face_of(view);
  double a = 0.0;
  double b = 0.0;
  if (!face_from_direction(face, view, a, b)) {
    return false;
  }
  const CubeCell cell = cube_cell(cube.layout, face);
  if (cube.layout != CubeLayout::face) {
    // Keeps a direction on the face that it was assigned to; another face may begin there in the
    // picture.
    constexpr double inside = 1.0 - 1e-9;
    a = minimum(maximum(a, -inside), inside);
    b = minimum(maximum(b, -inside), inside);
  }
  x = (2.0 * cell.column + 1.0 + a) / cube_columns(cube.layout) - 1.0;
  y = 1.0 - (2.0 * cell.row + 1.0 - b) / cube_rows(cube.layout);
  return true;
}

//! Returns 1 on faces and 0 in the empty cells of the cross.
template <class T>
ERGO_HD T cube_coverage(const CubePicture& cube, const T& x, const T& y) {
  using S = ScalarOf<T>;
  const T one(S(1));
  if (cube.layout != CubeLayout::cross) {
    return one;
  }
  const auto in_column = (x > T(S(-0.5))) & (x < T(S(0)));
  return select((absolute(y) < T(S(1) / S(3))) | in_column, one, T(S(0)));
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
