#include "tests/hard_cases/miss.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/shadow_chart.h"

namespace ergodome::test {

namespace {

//! The exact lens near a direction.
struct LensThere {
  bool bright;
  Vector3<double> sky;
  Vector3<double> along[2];  //!< derivatives along two axes of the camera's sky
};

//! Computes the lens by a Taylor series of order 20. Wherever the closed form can be evaluated, it
//! confirms these values.
LensThere lens_at(const CameraStation& camera, const Vector3<double>& n) {
  using D = Dual<double>;
  LensThere there{};
  there.bright = direction_is_bright(camera, n);
  if (!there.bright) {
    return there;
  }
  const Vector3<double> aside = std::abs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> e1 = normalized(cross(n, aside));
  const Vector3<double> e2 = cross(n, e1);
  const RayStart<D> start = start_ray(camera, Vector3<D>{D(n.x, e1.x, e2.x), D(n.y, e1.y, e2.y), D(n.z, e1.z, e2.z)});
  double steps = 0.0;
  const Vector3<D> sky =
      turned_to_camera(camera, trace_taylor<20>(camera.spin, start, true, {1e-12, 5000}, steps, there.bright).sky);
  there.sky = {sky.x.value, sky.y.value, sky.z.value};
  there.along[0] = {sky.x.along_x, sky.y.along_x, sky.z.along_x};
  there.along[1] = {sky.x.along_y, sky.y.along_y, sky.z.along_y};
  return there;
}

ExactRay exact_ray(const CameraStation& camera, const Vector3<double>& n) {
  const RayStart<double> start = start_ray(camera, n);
  ExactRay exact{comes_from_sky(camera.spin, camera.horizon_r, start), {}, {}, 0.0};
  if (exact.bright) {
    exact.sky = turned_to_camera(camera, trace_closed_form(camera.spin, start).sky);
    const LensThere there = lens_at(camera, n);
    exact.along[0] = there.along[0];
    exact.along[1] = there.along[1];
    exact.stretch = length(there.along[0]) + length(there.along[1]);
  }
  return exact;
}

}  // namespace

double displacement(const ExactRay& exact, const Vector3<double>& miss) {
  const Vector3<double> p = exact.along[0];
  const Vector3<double> q = exact.along[1];
  const Vector3<double> normal = cross(p, q);
  const double inverse = 1.0 / dot(normal, normal);
  const double x = (dot(q, q) * dot(p, miss) - dot(p, q) * dot(q, miss)) * inverse;
  const double y = (dot(p, p) * dot(q, miss) - dot(p, q) * dot(p, miss)) * inverse;
  return std::hypot(x, y);
}

std::vector<ExactRay> exact_rays(const CameraStation& camera, const Directions& rays) {
  std::vector<ExactRay> all;
  all.reserve(rays.size());
  for (const Vector3<double>& n : rays) {
    all.push_back(exact_ray(camera, n));
  }
  return all;
}

double Misses::screen_at(double share) const {
  if (screen.empty()) {
    return 0.0;
  }
  return screen[std::min(screen.size() - 1, static_cast<std::size_t>(share * static_cast<double>(screen.size())))];
}

Misses misses_of(const std::vector<ExactRay>& exact, const SeenSky& seen) {
  Misses misses;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const ExactRay& ray = exact[i];
    const Vector3<double> sky = {seen.sky[0][i], seen.sky[1][i], seen.sky[2][i]};
    const bool bright = seen.status[i] == static_cast<double>(LightEnd::sky);
    misses.improper += std::abs(length(sky) - (bright ? 1.0 : 0.0)) < 1e-5 ? 0 : 1;
    if (seen.status[i] == static_cast<double>(LightEnd::unresolved)) {
      ++misses.unresolved;
    } else if (bright != ray.bright) {
      ++misses.wrong;
    } else if (bright) {
      const Vector3<double> miss = sky - ray.sky;
      misses.sky = std::max(misses.sky, length(miss) - 1e-13 * ray.stretch);
      if (ray.stretch < winding_stretch) {
        misses.screen.push_back(displacement(ray, miss));
      }
    }
  }
  std::sort(misses.screen.begin(), misses.screen.end());
  return misses;
}

}  // namespace ergodome::test
