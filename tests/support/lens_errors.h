#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/dual.h"
#include "kernels/launch/launch.h"
#include "kernels/lens/look_up.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "tests/support/sanitized.h"

// Measures errors of a lens on the screen, by comparison with traced rays in random directions.
// Does not use the code with which lens builders measure errors.
namespace ergodome::test {

struct Rays {
  std::vector<double> n[3], sky[3], status, steps;
};

inline Rays random_rays(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Rays rays;
  for (int k = 0; k < 3; ++k) {
    rays.n[k].resize(count);
    rays.sky[k].resize(count);
  }
  rays.status.resize(count);
  rays.steps.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double v[3] = {normal(random), normal(random), normal(random)};
    const double length = std::hypot(v[0], v[1], v[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      rays.n[k][i] = v[k] / length;
    }
  }
  return rays;
}

//! Computes the sky directions of a camera's rays from a lens.
inline void read_through(const LensBlend& lens, const CameraStation& camera, const Aberration& observer, Rays& rays) {
  LookUpRaysBatch<double> batch{};
  batch.rays.camera = camera;
  batch.rays.settings = {1e-9, 10'000};
  batch.rays.count = static_cast<int>(rays.status.size());
  for (int k = 0; k < 3; ++k) {
    batch.rays.direction[k] = rays.n[k].data();
    batch.rays.sky[k] = rays.sky[k].data();
  }
  batch.rays.status = rays.status.data();
  batch.rays.steps = rays.steps.data();
  batch.lens = lens;
  batch.aberration = observer;
  launch(Backend::cpu, batch);
}

//! Returns the displacement on the observer's screen [rad] that corresponds to the error of a sky
//! direction: `seen` instead of the exact direction for `n`. Uses the exact Jacobian.
inline double displacement(const CameraStation& camera, const Vector3<double>& n, const Vector3<double>& seen) {
  using D = Dual<double>;
  const Vector3<double> aside = std::abs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> e1 = normalized(cross(n, aside));
  const Vector3<double> e2 = cross(n, e1);
  const RayStart<D> start = start_ray(camera, Vector3<D>{D(n.x, e1.x, e2.x), D(n.y, e1.y, e2.y), D(n.z, e1.z, e2.z)});
  double steps = 0.0;
  bool reached = false;
  const RayEnd<D> end = trace_taylor<20>(camera.spin, start, true, {1e-13, 5000}, steps, reached);
  const Vector3<double> j1 = {end.sky.x.along_x, end.sky.y.along_x, end.sky.z.along_x};
  const Vector3<double> j2 = {end.sky.x.along_y, end.sky.y.along_y, end.sky.z.along_y};
  const Vector3<double> miss = seen - Vector3<double>{end.sky.x.value, end.sky.y.value, end.sky.z.value};
  const Vector3<double> normal = cross(j1, j2);
  const double inverse = 1.0 / dot(normal, normal);
  const double x = (dot(j2, j2) * dot(j1, miss) - dot(j1, j2) * dot(j2, miss)) * inverse;
  const double y = (dot(j1, j1) * dot(j2, miss) - dot(j1, j2) * dot(j1, miss)) * inverse;
  return std::hypot(x, y);
}

struct Errors {
  std::vector<double> px;  //!< errors, in ascending order
  double traced = 0.0;     //!< fraction of the rays that the lens left to tracing

  [[nodiscard]] double at(double share) const {
    return px[std::min(px.size() - 1, static_cast<std::size_t>(share * static_cast<double>(px.size())))];
  }
};

//! Returns the errors on the screen, in pixels of angle `pixel`, for random directions that see the
//! sky. They include directions so close to the shadow that the grid cuts them off, and directions
//! that the lens leaves to tracing.
inline Errors screen_errors(const LensBlend& lens, const CameraStation& camera, const Aberration& observer,
                            double pixel, std::size_t count) {
  count /= sanitized ? 50 : 1;
  Rays rays = random_rays(count, 1);
  read_through(lens, camera, observer, rays);
  Errors errors;
  for (std::size_t i = 0; i < count; ++i) {
    if (rays.status[i] == 0.0) {
      const Vector3<double> n = {rays.n[0][i], rays.n[1][i], rays.n[2][i]};
      errors.px.push_back(displacement(camera, n, {rays.sky[0][i], rays.sky[1][i], rays.sky[2][i]}) / pixel);
      errors.traced += rays.steps[i] > 0.0 ? 1.0 : 0.0;
    }
  }
  errors.traced /= static_cast<double>(errors.px.size());
  std::sort(errors.px.begin(), errors.px.end());
  return errors;
}

}  // namespace ergodome::test
