#pragma once

#include "kernels/lens/look_up.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "tests/hard_cases/hard_case.h"

// All ways to compute what the rays of a case see, with a common result type.
namespace ergodome::test {

//! Sky directions and statuses of the rays of a case, by the methods under test.
struct SeenSky {
  std::vector<double> sky[3];
  std::vector<double> status;
};

//! Traces each ray, in double or in float; float rays start from the same directions, rounded.
SeenSky by_rays(const Place& place, const Directions& rays, TraceMethod method, double tolerance);
SeenSky by_float_rays(const Place& place, const Directions& rays, TraceMethod method, double tolerance);

//! The precision in which the nodes of a grid are traced.
enum class Nodes { in_double, in_float };

//! Looks the rays up in a lens.
SeenSky by_lens(const LensBlend& lens, const Place& place, const Directions& rays);

//! Looks the rays up in a grid that is built at the position, with a budget of 0.1 px of a 4096²
//! dome.
SeenSky by_live_grid(const Place& place, const Directions& rays, Nodes nodes);

//! Looks the rays up between two stations on both sides of the position, each packed and unpacked
//! as in a trajectory file.
SeenSky by_streamed_stations(const Place& place, const Directions& rays);

//! Looks the rays up in the published quadtree grid (splines).
SeenSky by_quadtree(const Place& place, const Directions& rays);

//! Angle of a pixel of a 4096² dome [rad].
inline constexpr double dome_pixel = 7.67e-4;

}  // namespace ergodome::test
