#include "tests/hard_cases/ray_sets.h"

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/projection/dome_fisheye.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "tests/support/sanitized.h"

namespace ergodome::test {

namespace {

constexpr int rays_a_sky = sanitized ? 60 : 600;

void add_with_neighbours(Directions& all, const Vector3<double>& n) {
  all.push_back(n);
  for (double angle = 1e-12; angle < 2e-3; angle *= 10.0) {
    all.push_back(beside(n, angle, 0.4));
    all.push_back(beside(n, angle, 3.9));
  }
}

Vector3<double> sky_of(const CameraStation& camera, const Vector3<double>& n) {
  const RayStart<double> start = start_ray(camera, n);
  if (!comes_from_sky(camera.spin, camera.horizon_r, start)) {
    return {0.0, 0.0, 0.0};
  }
  return trace_closed_form(camera.spin, start).sky;
}

//! Adds observed directions for which a function of the sky direction is zero, to the precision of
//! bisection. Searches along great circles of the camera's sky.
template <class Function>
void add_zeros(Directions& all, const CameraStation& camera, const Function& function, int circles) {
  constexpr int steps = 90;
  for (int circle = 0; circle < circles; ++circle) {
    const double tilt = pi * (circle + 0.25) / circles;
    const auto at = [&](double angle) {
      return Vector3<double>{std::cos(angle), std::sin(angle) * std::cos(tilt), std::sin(angle) * std::sin(tilt)};
    };
    const auto value = [&](double angle) { return function(sky_of(camera, at(angle))); };
    for (int i = 0; i < steps; ++i) {
      double low = 2.0 * pi * i / steps;
      double high = 2.0 * pi * (i + 1) / steps;
      const double at_low = value(low);
      if (!(at_low * value(high) < 0.0)) {
        continue;
      }
      for (int round = 0; round < 60; ++round) {
        const double middle = 0.5 * (low + high);
        (at_low * value(middle) > 0.0 ? low : high) = middle;
      }
      add_with_neighbours(all, at(low));
      add_with_neighbours(all, at(high));
    }
  }
}

}  // namespace

Vector3<double> any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Vector3<double> v = {normal(random), normal(random), normal(random)};
  return normalized(v);
}

Vector3<double> beside(const Vector3<double>& n, double angle, double side) {
  const Vector3<double> aside = std::abs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> e1 = normalized(cross(n, aside));
  const Vector3<double> e2 = cross(n, e1);
  return normalized(std::cos(angle) * n + std::sin(angle) * (std::cos(side) * e1 + std::sin(side) * e2));
}

Directions whole_sky(const CameraStation& /*camera*/) {
  std::mt19937_64 random(11);
  Directions all(rays_a_sky);
  for (Vector3<double>& n : all) {
    n = any_direction(random);
  }
  return all;
}

Directions beside_edge(const CameraStation& camera, double distance) {
  constexpr int points = sanitized ? 8 : 48;
  const ShadowChart chart = make_shadow_chart(camera);
  Directions all;
  for (int i = 0; i < points; ++i) {
    const double gamma = 2.0 * pi * (i + 0.3) / points;
    const double edge = edge_polar_angle(camera, chart, gamma);
    for (const double side : {1.0, -1.0}) {
      const double alpha = edge + side * distance;
      all.push_back(chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma));
    }
  }
  return all;
}

Directions about_principal_rays(const CameraStation& camera) {
  Directions all;
  add_with_neighbours(all, detail::principal_direction(camera, 1.0));
  add_with_neighbours(all, detail::principal_direction(camera, -1.0));
  return all;
}

Directions without_angular_momentum(const CameraStation& camera) {
  // L depends linearly on n, apart from a constant, so the directions with L = 0 form a circle on
  // the sphere.
  const Vector3<double> normal = camera.axial_momentum.along;
  const double size = std::sqrt(dot(normal, normal));
  Directions all;
  if (!(size > 1e-12)) {
    return whole_sky(camera);  // on the spin axis all light has zero angular momentum
  }
  const Vector3<double> pole = (1.0 / size) * normal;
  const double height = -camera.axial_momentum.constant / size;
  constexpr int points = sanitized ? 6 : 24;
  for (int i = 0; i < points; ++i) {
    add_with_neighbours(all, beside(pole, std::acos(height), 2.0 * pi * i / points));
  }
  return all;
}

Directions towards_sky_poles(const CameraStation& camera) {
  // At a pole of the sky, x and y both vanish. Zeros of x alone, along circles that pass close to
  // the pole, are close enough to it.
  Directions all;
  add_zeros(
      all, camera, [](const Vector3<double>& sky) { return std::abs(sky.z) > 0.9 ? sky.x : 0.0; }, sanitized ? 3 : 24);
  return all;
}

Directions towards_sky_seam(const CameraStation& camera) {
  Directions all;
  add_zeros(
      all, camera, [](const Vector3<double>& sky) { return sky.x < 0.0 ? sky.y : 0.0; }, sanitized ? 2 : 12);
  return all;
}

Directions dome_zenith_and_rim(const CameraStation& /*camera*/) {
  constexpr int size_px = 4096;
  const Projection dome = make_dome_projection(size_px, pi, pi / 6.0);
  Directions all;
  const auto add = [&](double x_px, double y_px) {
    const Vector3<double> v = direction_from_pixel(dome, x_px, y_px);
    // Converts from the axes of a view that faces the hole: right is e_φ, up is -e_θ, back is e_r.
    all.push_back(normalized(Vector3<double>{v.z, -v.y, v.x}));
  };
  constexpr double middle = 0.5 * size_px;
  for (const double beside_px : {0.0, 1e-6, 0.5}) {
    add(middle + beside_px, middle);
    add(middle, middle - beside_px);
  }
  for (int i = 0; i < 360; i += sanitized ? 45 : 3) {
    const double angle = pi * i / 180.0;
    for (const double inwards_px : {0.0, 1e-6, 0.5}) {
      add(middle + (middle - inwards_px) * std::cos(angle), middle + (middle - inwards_px) * std::sin(angle));
    }
  }
  return all;
}

Directions along_axes(const CameraStation& /*camera*/) {
  Directions all;
  for (const double sign : {1.0, -1.0}) {
    add_with_neighbours(all, {sign, 0.0, 0.0});
    add_with_neighbours(all, {0.0, sign, 0.0});
    add_with_neighbours(all, {0.0, 0.0, sign});
  }
  return all;
}

}  // namespace ergodome::test
