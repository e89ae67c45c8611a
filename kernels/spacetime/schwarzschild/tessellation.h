#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

// How finely triangles are divided, and which of them cannot be drawn: Müller, Schulz & Weiskopf (2021), section 3.2. Points are on the
// screen, in any unit.
namespace ergodome::inline ERGO_TARGET {

//! A point on the screen.
struct ScreenPoint {
  double x, y;
};

//! What the level of tessellation depends on; the defaults are those of the sphere's pictures.
struct TessellationSettings {
  double most = 64.0;   //!< MaxTessLevel
  double factor = 5.0;  //!< a
  double power = 0.75;  //!< b
};

ERGO_HD double screen_distance(const ScreenPoint& p, const ScreenPoint& q) { return ::hypot(p.x - q.x, p.y - q.y); }

//! How far an edge's middle lies from the middle of its ends, over the edge's length: eq. 18. Edges without length have none.
ERGO_HD double apparent_curvature(const ScreenPoint& first, const ScreenPoint& middle, const ScreenPoint& last) {
  const double length = screen_distance(first, last);
  const double bow = screen_distance(middle, {0.5 * (first.x + last.x), 0.5 * (first.y + last.y)});
  return length > 0.0 ? bow / length : 0.0;
}

//! The number of parts that an edge is divided into: eq. 19, but 1 at least. Grows with curvature.
ERGO_HD double tessellation_level(double curvature, const TessellationSettings& settings) {
  const double share = settings.factor * ::pow(curvature, settings.power);
  return ::fmax(1.0, settings.most * ::fmin(1.0, ::fmax(0.0, share)));
}

//! Whether a triangle is torn apart by the hole: its circumference is more than `limit` times that of the undistorted one. Such a triangle
//! contains a point straight behind the hole, which is seen as a ring.
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
