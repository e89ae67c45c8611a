#include "render/diagram/light_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "kernels/spacetime/schwarzschild/ray_curve.h"
#include "tests/render/diagram/point.h"

// Tests of light rays as diagrams draw them.
namespace ergodome {
namespace {

using test::length_of;
using test::Point;

struct RayCase {
  Point observer, point;
  int order;
};

const RayCase ray_cases[] = {{{40.0, 0.0, 0.0}, {-5.0, 3.0, -0.5}, 1}, {{40.0, 0.0, 0.0}, {-5.0, 3.0, -0.5}, 2},
                             {{40.0, 0.0, 0.0}, {6.0, 0.0, 1.0}, 2},   {{3.0, -12.0, 9.0}, {0.5, 0.3, -2.4}, 1},
                             {{0.0, 0.0, 40.0}, {16.5, 0.0, 0.5}, 3},  {{7.0, 1.0, 0.0}, {-7.0, 2.0, 3.0}, 5}};

//! A point of a curve in the plane of observer and point: inverse radius, and azimuth from the
//! observer.
struct OrbitPosition {
  double u, phi;
};
std::vector<OrbitPosition> orbit_of(const RayCase& ray, const std::vector<Point>& curve) {
  const ConnectionPlane plane = connection_plane(ray.observer, ray.point);
  const double side = ray.order % 2 == 1 ? 1.0 : -1.0;
  std::vector<OrbitPosition> orbit;
  double before = 0.0;
  for (auto position = curve.rbegin(); position != curve.rend(); ++position) {
    const double phi = std::atan2(side * dot(plane.across, *position), dot(plane.outward, *position));
    before += std::remainder(phi - before, 2.0 * 3.14159265358979323846);
    orbit.push_back({1.0 / length_of(*position), before});
  }
  return orbit;
}

TEST(LightCurve, BeginsAtThePointAndEndsAtTheObserver) {
  for (const RayCase& ray : ray_cases) {
    const std::vector<Point> curve = light_curve(ray.observer, ray.point, ray.order);
    ASSERT_GT(curve.size(), 30U);
    EXPECT_LT(length_of(curve.front() - ray.point), 1e-12 * length_of(ray.point));
    EXPECT_LT(length_of(curve.back() - ray.observer), 1e-12 * length_of(ray.observer));
  }
}

TEST(LightCurve, StaysInThePlaneOfTheHoleTheObserverAndThePoint) {
  for (const RayCase& ray : ray_cases) {
    const Point normal = cross(ray.observer, ray.point);
    for (const Point& position : light_curve(ray.observer, ray.point, ray.order)) {
      EXPECT_LT(std::abs(dot(normal, position)), 1e-12 * length_of(normal) * length_of(position));
    }
  }
}

TEST(LightCurve, FulfilsTheEquationOfItsOrbit) {
  for (const RayCase& ray : ray_cases) {
    const std::vector<OrbitPosition> orbit = orbit_of(ray, light_curve(ray.observer, ray.point, ray.order));
    const ConnectionPlane plane = connection_plane(ray.observer, ray.point);
    const double angle = image_angle(plane.phi, ray.order);
    const double b = connecting_ray(plane.r_observer, plane.r, angle).impact_parameter;
    // Computes du/dφ from differences of eighth order between points of the curve. Each half of the
    // curve has a constant step of φ.
    for (std::size_t i = 4; i + 4 < orbit.size(); ++i) {
      const double step = orbit[i + 1].phi - orbit[i].phi;
      const double rate =
          (4.0 / 5.0 * (orbit[i + 1].u - orbit[i - 1].u) - 1.0 / 5.0 * (orbit[i + 2].u - orbit[i - 2].u) +
           4.0 / 105.0 * (orbit[i + 3].u - orbit[i - 3].u) - 1.0 / 280.0 * (orbit[i + 4].u - orbit[i - 4].u)) /
          step;
      const double u = orbit[i].u;
      EXPECT_NEAR(rate * rate, 1.0 / (b * b) - u * u + 2.0 * u * u * u, 1e-9) << ray.order << " " << i;
    }
  }
}

TEST(LightCurve, SweepsTheAzimuthOfItsImage) {
  for (const RayCase& ray : ray_cases) {
    const std::vector<OrbitPosition> orbit = orbit_of(ray, light_curve(ray.observer, ray.point, ray.order));
    const ConnectionPlane plane = connection_plane(ray.observer, ray.point);
    EXPECT_NEAR(orbit.back().phi, image_angle(plane.phi, ray.order), 1e-10);
  }
}

TEST(LightCurve, LeavesTheObserverWhereThePointIsSeen) {
  for (const RayCase& ray : ray_cases) {
    // Compares the direction at the observer with differences between the first points of the
    // curve; radial lengths are those that an observer at rest measures.
    const ConnectionPlane plane = connection_plane(ray.observer, ray.point);
    const double angle = image_angle(plane.phi, ray.order);
    const std::vector<Point> curve = light_curve(ray.observer, ray.point, ray.order);
    const double step = angle / static_cast<double>(curve.size() - 1);
    const auto u = [&](std::size_t i) { return 1.0 / length_of(curve[curve.size() - 1 - i]); };
    const double rate =
        (-147.0 * u(0) + 360.0 * u(1) - 450.0 * u(2) + 400.0 * u(3) - 225.0 * u(4) + 72.0 * u(5) - 10.0 * u(6)) /
        (60.0 * step);
    const double r = plane.r_observer;
    const double side = ray.order % 2 == 1 ? 1.0 : -1.0;
    const Point tangent = (-rate * r * r / std::sqrt(1.0 - 2.0 / r)) * plane.outward + (side * r) * plane.across;
    const Point seen = apparent_position(ray.observer, ray.point, ray.order).direction;
    EXPECT_LT(length_of((1.0 / length_of(tangent)) * tangent - seen), 1e-6) << ray.order;
  }
}

TEST(LightCurve, WithoutARayThereIsNone) {
  EXPECT_TRUE(light_curve({40.0, 0.0, 0.0}, {1.5, 0.0, 0.0}, 1).empty());
  EXPECT_TRUE(light_curve({40.0, 0.0, 0.0}, {40.0, 0.0, 0.0}, 1).empty());
}

TEST(LightCurve, ARadialRayIsAStraightLine) {
  for (const Point& position : light_curve({40.0, 0.0, 0.0}, {8.0, 0.0, 0.0}, 1)) {
    EXPECT_EQ(position.y, 0.0);
    EXPECT_EQ(position.z, 0.0);
  }
}

}  // namespace
}  // namespace ergodome
