#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/quad.h"
#include "kernels/core/vector3.h"

// The sky as a cube map: no poles and no seam. Each face carries a border of one texel taken from its neighbours, so a bilinear look-up
// never leaves its face; a mip pyramid goes down to one texel a face. Faces are warped so that their texels subtend nearly equal
// solid angles.
namespace ergodome {

inline constexpr int cube_level_limit = 16;

//! A cube map as kernels read it. Face order: +x, -x, +y, -y, +z, -z.
struct CubeMap {
  const float* texels;                  //!< four floats a texel (red, green, blue, unused), 16-byte aligned
  long level_offset[cube_level_limit];  //!< in texels; a level holds 6 faces of (size + 2)² texels, border included
  int face_size;                        //!< of level 0; a power of two; level k has face_size >> k
  int level_count;
};

inline namespace ERGO_TARGET {

//! The warp of a face coordinate in [-1, 1]: close to 4/π atan(s), which makes texels equal in angle, without the arctangent.
//! f(s) = s (1.27 - 0.27 s²) would miss the slope at the edge; the quintic below is within 0.4 % of the arctangent.
ERGO_HD float warped(float s) {
  const float s2 = s * s;
  return s * (1.27105F + s2 * (-0.38095F + s2 * 0.1099F));
}

//! The inverse of `warped`, by Newton's method.
ERGO_HD double unwarped(double w) {
  double s = w;
  for (int round = 0; round < 8; ++round) {
    const double s2 = s * s;
    const double value = s * (1.27105 + s2 * (-0.38095 + s2 * 0.1099));
    const double slope = 1.27105 + s2 * (-3.0 * 0.38095 + s2 * 5.0 * 0.1099);
    s -= (value - w) / slope;
  }
  return s;
}

//! A place on the cube: face and warped coordinates in [-1, 1].
struct CubePlace {
  int face;
  float x;
  float y;
};

ERGO_HD CubePlace cube_place(const Vector3<float>& d) {
  const float ax = ::fabsf(d.x);
  const float ay = ::fabsf(d.y);
  const float az = ::fabsf(d.z);
  if (ax >= ay && ax >= az) {
    return {d.x < 0.0F ? 1 : 0, warped(d.y / ax), warped(d.z / ax)};
  }
  if (ay >= az) {
    return {d.y < 0.0F ? 3 : 2, warped(d.x / ay), warped(d.z / ay)};
  }
  return {d.z < 0.0F ? 5 : 4, warped(d.x / az), warped(d.y / az)};
}

//! The direction (not of unit length) of a place on a face; x and y may lie a little outside [-1, 1].
ERGO_HD Vector3<double> cube_direction(int face, double x, double y) {
  const double s = unwarped(x);
  const double t = unwarped(y);
  const double side = face % 2 == 0 ? 1.0 : -1.0;
  switch (face / 2) {
    case 0:
      return {side, s, t};
    case 1:
      return {s, side, t};
    default:
      return {s, t, side};
  }
}

//! Index of a texel of a face at a level; x and y from -1 (the border) to size.
ERGO_HD long texel_index(const CubeMap& map, int level, int face, int x, int y) {
  const long stride = (map.face_size >> level) + 2;
  return map.level_offset[level] + (static_cast<long>(face) * stride + (y + 1)) * stride + (x + 1);
}

//! Bilinear look-up at one level.
ERGO_HD Quad cube_bilinear(const CubeMap& map, int level, const CubePlace& place) {
  const float size = static_cast<float>(map.face_size >> level);
  // Rounding can put a place on the rim a hair outside; the border has one texel to give.
  const float x = minimum(maximum((place.x + 1.0F) * 0.5F * size - 0.5F, -0.5F), size - 0.5F);
  const float y = minimum(maximum((place.y + 1.0F) * 0.5F * size - 0.5F, -0.5F), size - 0.5F);
  const float x_floor = ::floorf(x);
  const float y_floor = ::floorf(y);
  const float fx = x - x_floor;
  const float fy = y - y_floor;
  const long stride = (map.face_size >> level) + 2;
  const float* top =
      map.texels + 4 * texel_index(map, level, place.face, static_cast<int>(x_floor), static_cast<int>(y_floor));
  const float* bottom = top + 4 * stride;
  return (1.0F - fy) * ((1.0F - fx) * load_quad(top) + fx * load_quad(top + 4)) +
         fy * ((1.0F - fx) * load_quad(bottom) + fx * load_quad(bottom + 4));
}

//! The mean over the whole sky, from the coarsest level (one texel a face; by symmetry the faces are equal in solid angle).
ERGO_HD Vector3<float> cube_mean(const CubeMap& map) {
  Vector3<float> sum = {0.0F, 0.0F, 0.0F};
  for (int face = 0; face < 6; ++face) {
    const float* texel = map.texels + 4 * texel_index(map, map.level_count - 1, face, 0, 0);
    sum = sum + Vector3<float>{texel[0], texel[1], texel[2]};
  }
  return (1.0F / 6.0F) * sum;
}

//! Angle that a texel of level 0 subtends [rad]: a quarter turn is a face.
ERGO_HD float cube_texel_angle(const CubeMap& map) { return 1.57079633F / static_cast<float>(map.face_size); }

}  // namespace ERGO_TARGET
}  // namespace ergodome
