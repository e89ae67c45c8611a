#pragma once

#include "kernels/lens/look_up.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "tests/hard_cases/hard_case.h"

// All methods to compute what the rays of a case see. The results have a common type.
namespace ergodome::test {

//! What the rays of a case see, by one method: sky directions and statuses.
struct SeenSky {
  std::vector<double> sky[3];
  std::vector<double> status;
};

//! by_rays() traces each ray in double, by_float_rays() in float. The directions are the same,
//! except that they are rounded to float in the second case.
SeenSky by_rays(const CameraState& camera_state, const Directions& rays, TraceMethod method, double tolerance);
SeenSky by_float_rays(const CameraState& camera_state, const Directions& rays, TraceMethod method, double tolerance);

//! The precision in which the nodes of a grid are traced.
enum class Nodes { in_double, in_float };

//! Computes the sky directions of the rays by interpolation in a lens.
SeenSky by_lens(const LensBlend& lens, const CameraState& camera_state, const Directions& rays);

//! Computes the sky directions of the rays by interpolation in a lens grid. It is built for the
//! camera's position, with a budget of 0.1 px of a 4096² dome.
SeenSky by_live_grid(const CameraState& camera_state, const Directions& rays, Nodes nodes);

//! Computes the sky directions of the rays by interpolation between two lens grids, at a smaller
//! and at a larger radius than the camera's. Both grids are encoded and decoded as in a trajectory
//! file.
SeenSky by_streamed_stations(const CameraState& camera_state, const Directions& rays);

//! Computes the sky directions of the rays by spline interpolation in the published quadtree grid.
SeenSky by_quadtree(const CameraState& camera_state, const Directions& rays);

//! Angle of a pixel of a 4096² dome [rad].
inline constexpr double dome_pixel = 7.67e-4;

}  // namespace ergodome::test
