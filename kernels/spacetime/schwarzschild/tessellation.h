#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

// Tessellation levels of triangles, and triangles that cannot be drawn: Müller, Schulz & Weiskopf
// (2021), section 3.2. Points are on the screen, in any unit.
namespace ergodome::inline ERGO_TARGET {

//! A point on the screen.
struct ScreenPoint {
  double x, y;
};

//! Parameters of the tessellation level; the defaults are those of the pictures of the sphere.
struct TessellationSettings {
  double maximum = 64.0;  //!< MaxTessLevel
  double factor = 5.0;    //!< a of eq. 19
  double power = 0.75;    //!< b of eq. 19
};

ERGO_HD double screen_distance(const ScreenPoint& p, const ScreenPoint& q) { return ::hypot(p.x - q.x, p.y - q.y); }

//! Returns the distance between an edge's middle and the midpoint of its ends, relative to the
//! edge's length: eq. 18. Returns 0 for edges without length.
ERGO_HD double apparent_curvature(const ScreenPoint& first, const ScreenPoint& middle, const ScreenPoint& last) {
  const double length = screen_distance(first, last);
  const double bow = screen_distance(middle, {0.5 * (first.x + last.x), 0.5 * (first.y + last.y)});
  return length > 0.0 ? bow / length : 0.0;
}

//! Returns the number of parts that an edge is divided into, not rounded: eq. 19, clamped to 1 to
//! `settings.maximum`. Grows with curvature.
ERGO_HD double tessellation_level(double curvature, const TessellationSettings& settings) {
  const double share = settings.factor * ::pow(curvature, settings.power);
  return ::fmax(1.0, settings.maximum * ::fmin(1.0, ::fmax(0.0, share)));
}

//! Returns whether a triangle is torn apart by the hole: its perimeter is more than `limit` times
//! that of the undistorted one. Such a triangle contains a point exactly behind the hole, which is
//! seen as a ring.
ERGO_HD bool is_torn(const ScreenPoint (&seen)[3], const ScreenPoint (&undistorted)[3], double limit) {
  double around = 0.0;
  double around_undistorted = 0.0;
  for (int i = 0; i < 3; ++i) {
    around += screen_distance(seen[i], seen[(i + 1) % 3]);
    around_undistorted += screen_distance(undistorted[i], undistorted[(i + 1) % 3]);
  }
  return around > limit * around_undistorted;
}

}  // namespace ergodome::inline ERGO_TARGET
