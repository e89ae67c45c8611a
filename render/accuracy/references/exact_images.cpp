#include "render/accuracy/references/exact_images.h"

#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/geodesic/taylor.h"

namespace ergodome {

namespace {

using ImageDual = Dual<double>;

constexpr int max_steps = 12;
//! Accepted angle on the sky between a ray and the star [rad].
constexpr double reached = 1e-11;

Vector3<double> unit(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

double angle_between(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> across = cross(a, b);
  return std::atan2(std::sqrt(dot(across, across)), dot(a, b));
}

//! Rotates a star's direction around the spin axis into the axes of a camera at azimuth 0.
Vector3<double> turned_back(const CameraStation& camera, const Vector3<double>& v) {
  return {camera.cosine_phi * v.x + camera.sine_phi * v.y, camera.cosine_phi * v.y - camera.sine_phi * v.x, v.z};
}

struct Tangents {
  Vector3<double> first;
  Vector3<double> second;
};

Tangents tangents_of(const Vector3<double>& n) {
  const Vector3<double> aside = std::abs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> first = unit(cross(n, aside));
  return {first, cross(n, first)};
}

//! Computes the derivatives of the sky direction along the two tangents of the view direction n.
//! Light must come from the sky there. Returns false if the ray does not converge.
bool slopes(const CameraStation& camera, const Vector3<double>& n, const Tangents& t, Vector3<double>& along_first,
            Vector3<double>& along_second) {
  const Vector3<ImageDual> direction = {ImageDual(n.x, t.first.x, t.second.x), ImageDual(n.y, t.first.y, t.second.y),
                                        ImageDual(n.z, t.first.z, t.second.z)};
  double steps = 0.0;
  bool arrived = false;
  const RayEnd<ImageDual> end =
      trace_taylor<20>(camera.spin, start_ray(camera, direction), true, {1e-11, 5000}, steps, arrived);
  along_first = {end.sky.x.along_x, end.sky.y.along_x, end.sky.z.along_x};
  along_second = {end.sky.x.along_y, end.sky.y.along_y, end.sky.z.along_y};
  return arrived;
}

std::optional<ExactImage> follow(const CameraStation& camera, const Vector3<double>& star, Vector3<double> n,
                                 double reach) {
  const Vector3<double> begin = n;
  for (int step = 0; step < max_steps; ++step) {
    const RayStart<double> start = start_ray(camera, n);
    const Tangents t = tangents_of(n);
    Vector3<double> first;
    Vector3<double> second;
    if (!comes_from_sky(camera.spin, camera.horizon_r, start) || !slopes(camera, n, t, first, second)) {
      return std::nullopt;
    }
    const Vector3<double> miss = star - trace_closed_form(camera.spin, start).sky;
    const Vector3<double> area = cross(first, second);
    const double square = dot(area, area);
    if (dot(miss, miss) < reached * reached) {
      return angle_between(n, begin) <= reach ? std::optional(ExactImage{n, 1.0 / std::sqrt(square)}) : std::nullopt;
    }
    const double a = (dot(second, second) * dot(first, miss) - dot(first, second) * dot(second, miss)) / square;
    const double b = (dot(first, first) * dot(second, miss) - dot(first, second) * dot(first, miss)) / square;
    const double length = std::hypot(a, b);
    const double shorter = length > 0.3 ? 0.3 / length : 1.0;
    if (!std::isfinite(length)) {
      return std::nullopt;
    }
    n = unit(n + (shorter * a) * t.first + (shorter * b) * t.second);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<ExactImage>> exact_images(const EyeCamera& eye, const std::vector<Vector3<double>>& stars,
                                                    const std::vector<Vector3<double>>& found, double reach) {
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  std::vector<std::optional<ExactImage>> images(found.size());
  parallel_for(static_cast<int>(found.size()), 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      images[at] = follow(camera, turned_back(camera, stars[at]), unit(found[at]), reach);
    }
  });
  return images;
}

}  // namespace ergodome
