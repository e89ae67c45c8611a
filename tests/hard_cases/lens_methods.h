#pragma once

#include "kernels/lens/look_up.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "tests/hard_cases/hard_case.h"

namespace ergodome::test {

//! What became of the rays of a case.
struct SeenSky {
  std::vector<double> sky[3];
  std::vector<double> status;
};

//! Rays of their own, in double or in float; what is traced in float starts from the same
//! directions, rounded.
SeenSky by_rays(const Place& place, const Directions& rays, TraceMethod method, double tolerance);
SeenSky by_float_rays(const Place& place, const Directions& rays, TraceMethod method, double tolerance);

//! How a grid's nodes are traced.
enum class Nodes { in_double, in_float };

//! Read through a lens of the place.
SeenSky by_lens(const LensBlend& lens, const Place& place, const Directions& rays);

//! Read from a grid that is built for the place with a budget of 0.1 px of a dome of 4096².
SeenSky by_live_grid(const Place& place, const Directions& rays, Nodes nodes);

//! Read from two stations to both sides of the place, each packed and unpacked as in a trajectory
//! file.
SeenSky by_streamed_stations(const Place& place, const Directions& rays);

//! Read from the published quadtree grid (splines).
SeenSky by_quadtree(const Place& place, const Directions& rays);

//! Angle of a pixel of a dome of 4096² [rad].
inline constexpr double dome_pixel = 7.67e-4;

}  // namespace ergodome::test
