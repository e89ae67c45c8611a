#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/quad.h"
#include "kernels/core/vector3.h"

// The sky as a cube map, without poles and seams. Each face has a border of one texel from its
// neighbors, so a bilinear look-up never leaves its face. A mip pyramid goes down to one texel per
// face. Faces are warped so that their texels subtend nearly equal solid angles.
namespace ergodome {

inline constexpr int cube_level_limit = 16;

//! Range of ln T of texels, 1500 K to 40,000 K, and its midpoint. Texels store the difference from
//! the midpoint, which half floats hold more accurately than ln T itself.
inline constexpr float lowest_log_temperature = 7.31322F;
inline constexpr float highest_log_temperature = 10.59663F;
inline constexpr float log_reference_temperature = 0.5F * (lowest_log_temperature + highest_log_temperature);

//! A cube map as kernels read it. Face order: +x, -x, +y, -y, +z, -z.
//!
//! Texels are half floats, because memory access limits the filters. Multiplied by `scale`, they are
//! red, green, blue and a fourth number. For SkyShift::blackbody_fit it is the luminance times
//! (ln T - log_reference_temperature), where T [K] is the temperature of the blackbody nearest in
//! color; otherwise it is undefined. After filtering, dividing it by the filtered luminance yields
//! the luminance-weighted mean of the difference, so dark texels have no influence.
struct CubeMap {
  const HalfQuad* texels;
  //! Power of two for which the brightest color component of the source is from 16,384 to 32,768.
  //! Numbers have 11 significant bits, and fewer only below 4e-9 of the brightest.
  float scale;
  long level_offset[cube_level_limit];  //!< first texel of each level; a level has 6 (size + 2)² texels
  //! Width of a face at level 0, a power of two; level k has face_size >> k.
  int face_size;
  int level_count;
};

inline namespace ERGO_TARGET {

//! Warps a face coordinate in [-1, 1]: close to 4/π atan(s), which makes texels equal in angle,
//! without the arctangent. f(s) = s (1.27 - 0.27 s²) would miss the slope at the edge; the quintic
//! below is within 0.4 % of the arctangent.
template <class T>
ERGO_HD T warped(const T& s) {
  const T s2 = s * s;
  return s * (s2 * (s2 * 0.1099F - 0.38095F) + 1.27105F);
}

//! Returns the inverse of warped(), by Newton's method.
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

//! A position on the cube: face (an integer) and warped coordinates in [-1, 1].
template <class T>
struct CubePosition {
  T face;
  T x;
  T y;
};

template <class T>
ERGO_HD CubePosition<T> cube_position(const Vector3<T>& d) {
  const T zero(0.0F);
  const T ax = absolute(d.x);
  const T ay = absolute(d.y);
  const T az = absolute(d.z);
  const auto on_x = (ax >= ay) & (ax >= az);
  const auto on_y = ay >= az;  // where not on x
  const T main = select(on_x, d.x, select(on_y, d.y, d.z));
  const T per_main = T(1.0F) / absolute(main);
  const T face = select(on_x, zero, select(on_y, T(2.0F), T(4.0F))) + select(main < zero, T(1.0F), zero);
  return {face, warped(select(on_x, d.y, d.x) * per_main), warped(select(on_x | on_y, d.z, d.y) * per_main)};
}

//! Returns the direction (not of unit length) of a point of a face, whose sides are at -1 and 1.
ERGO_HD Vector3<double> cube_point(int face, double s, double t) {
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

//! Returns the direction of a position on a face in warped coordinates; x and y may be slightly
//! outside [-1, 1].
ERGO_HD Vector3<double> cube_direction(int face, double x, double y) {
  return cube_point(face, unwarped(x), unwarped(y));
}

//! Returns the index of a texel of a face at a level; x and y from -1 (the border) to size.
ERGO_HD long texel_index(const CubeMap& map, int level, int face, int x, int y) {
  const long stride = (map.face_size >> level) + 2;
  return map.level_offset[level] + (static_cast<long>(face) * stride + (y + 1)) * stride + (x + 1);
}

//! The texels of a bilinear look-up at one level: a texel, its right, lower and lower right
//! neighbors.
template <class T>
struct BilinearPosition {
  IntegerOf<T> texel;  //!< index of the upper left texel in its level
  T right;             //!< weight of the right pair, in [0, 1]
  T lower;
};

//! Finds the texels of a look-up. `size` is that of the level's faces in texels.
template <class T>
ERGO_HD BilinearPosition<T> bilinear_position(const CubePosition<T>& position, const T& size) {
  // Texels are counted from the border, so that their numbers are positive. Rounding can put a
  // position slightly outside the face, where only one border texel exists, so positions are
  // clamped to the face.
  const T half(0.5F);
  const T x = minimum(maximum((position.x + 1.0F) * 0.5F * size + half, half), size + half);
  const T y = minimum(maximum((position.y + 1.0F) * 0.5F * size + half, half), size + half);
  const IntegerOf<T> column = truncated(x);
  const IntegerOf<T> row = truncated(y);
  const IntegerOf<T> stride = truncated(size + 2.0F);
  return {(truncated(position.face) * stride + row) * stride + column, x - real_of<T>(column), y - real_of<T>(row)};
}

//! Returns the mean over the whole sky, from the coarsest level (one texel per face; by symmetry
//! all faces have equal solid angles).
ERGO_HD Quad cube_mean_texel(const CubeMap& map) {
  Quad sum = quad_of(0.0F);
  for (int face = 0; face < 6; ++face) {
    sum = sum + load_quad(map.texels + texel_index(map, map.level_count - 1, face, 0, 0));
  }
  return (map.scale * (1.0F / 6.0F)) * sum;
}

ERGO_HD Vector3<float> cube_mean(const CubeMap& map) {
  const Quad mean = cube_mean_texel(map);
  return {quad_part(mean, 0), quad_part(mean, 1), quad_part(mean, 2)};
}

//! Returns the angle that a texel of level 0 subtends [rad]; a face is a quarter turn.
ERGO_HD float cube_texel_angle(const CubeMap& map) { return 1.57079633F / static_cast<float>(map.face_size); }

}  // namespace ERGO_TARGET
}  // namespace ergodome
