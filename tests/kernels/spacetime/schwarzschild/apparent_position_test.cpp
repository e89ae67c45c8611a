#include "kernels/spacetime/schwarzschild/apparent_position.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/schwarzschild/tessellation.h"

namespace ergodome {
namespace {

using Point = Vector3<double>;

double size(const Point& p) { return std::sqrt(dot(p, p)); }

struct Photon {
  Point position, speed;
  double time = 0.0;
};

//! Follows a photon for a coordinate time by the Runge-Kutta method. In the affine parameter, its
//! equations are x'' = -3 h² x / r⁵ and t' = 1 / (1 - 2/r). `to` is its initial direction for a
//! static observer.
Photon followed(const Point& from, const Point& to, double time) {
  const double r = size(from);
  const Point radial = (1.0 / r) * from;
  const double across = 1.0 / std::sqrt(1.0 - 2.0 / r);
  const Point start = dot(to, radial) * radial + across * (to - dot(to, radial) * radial);
  const double h2 = dot(from, from) * dot(start, start) - dot(from, start) * dot(from, start);
  // Steps in coordinate time.
  const auto change = [h2](const Photon& p) {
    const double distance = size(p.position);
    const double f = 1.0 - 2.0 / distance;
    return Photon{f * p.speed, (-3.0 * f * h2 / std::pow(distance, 5)) * p.position};
  };
  const auto moved = [](const Photon& p, const Photon& d, double h) {
    return Photon{p.position + h * d.position, p.speed + h * d.speed};
  };
  Photon photon{from, start};
  constexpr int steps = 6'000;
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Photon k1 = change(photon);
    const Photon k2 = change(moved(photon, k1, 0.5 * h));
    const Photon k3 = change(moved(photon, k2, 0.5 * h));
    const Photon k4 = change(moved(photon, k3, h));
    photon = moved(moved(moved(moved(photon, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
  }
  return photon;
}

TEST(ApparentPosition, RaysFollowedFromTheObserverAndFromThePointMeetTheOtherEnd) {
  const Point observers[] = {{40.0, 0.0, 0.0}, {-3.0, 12.0, 9.0}, {0.0, 0.0, 2.7}};
  const Point points[] = {{-5.0, 3.5, -2.0}, {2.0, -6.0, 1.0}, {0.5, 0.3, -2.4}, {-7.0, 20.0, 3.0}};
  for (const Point& observer : observers) {
    for (const Point& point : points) {
      for (const int order : {1, 2, 3}) {
        const ApparentPosition position = apparent_position(observer, point, order);
        EXPECT_NEAR(size(position.direction), 1.0, 1e-14);
        EXPECT_LT(size(followed(observer, position.direction, position.travel_time).position - point), 1e-5) << order;
        EXPECT_LT(size(followed(point, position.emission_direction, position.travel_time).position - observer), 1e-5)
            << order;
      }
    }
  }
}

TEST(ApparentPosition, FarFromTheHolePointsAreWhereTheyAre) {
  const Point observer{1e9, 2e9, 0.0};
  const Point point{2e9, 1e9, 3e9};
  const ApparentPosition position = apparent_position(observer, point, 1);
  const Point there = point - observer;
  EXPECT_LT(size(position.direction - (1.0 / size(there)) * there), 1e-7);
  EXPECT_LT(size(position.emission_direction + (1.0 / size(there)) * there), 1e-7);
  EXPECT_NEAR(position.travel_time, size(there), 1e-7 * size(there));
}

TEST(ApparentPosition, APointInLineWithTheHoleIsSeenOnARing) {
  for (const Point& observer : {Point{40.0, 0.0, 0.0}, Point{0.0, -40.0, 0.0}, Point{0.0, 0.0, 40.0}}) {
    const ApparentPosition position = apparent_position(observer, -0.2 * observer, 1);
    const ConnectingRay ray = connecting_ray(40.0, 8.0, pi);
    EXPECT_NEAR(dot(position.direction, observer) / 40.0, std::cos(ray.xi), 1e-14);
    const ApparentPosition across = apparent_position(observer, -0.2 * observer, 2);
    EXPECT_LT(size(position.direction + across.direction - (2.0 * std::cos(ray.xi) / 40.0) * observer), 1e-13);
  }
}

TEST(ApparentPosition, LightThatClimbsReddens) {
  EXPECT_NEAR(static_frequency_ratio(4.0, 1e12), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(static_frequency_ratio(6.0, 6.0), 1.0);
}

TEST(Illuminance, FallsWithTheSquareOfTheTimeAndWithTheAngle) {
  // Radial light is not deflected, and its travel time is the tortoise distance.
  const Point light{20.0, 0.0, 0.0};
  const Point point{5.0, 0.0, 0.0};
  const double time = connecting_ray(20.0, 5.0, 0.0).travel_time;
  EXPECT_NEAR(illuminance(light, point, {1.0, 0.0, 0.0}, 1, 3.0), 3.0 / (time * time), 1e-15);
  EXPECT_EQ(illuminance(light, point, {-1.0, 0.0, 0.0}, 1, 3.0), 0.0);
  // An oblique surface at r = 5. A static observer measures radial lengths that are longer by
  // 1/√(3/5), which changes the angle of the surface.
  const double slope = std::atan(std::sqrt(0.6));  // tan 45° × √(1 - 2/r): radial part of the normal
  EXPECT_NEAR(illuminance(light, point, {std::sqrt(0.5), std::sqrt(0.5), 0.0}, 1, 1.0), std::sin(slope) / (time * time),
              1e-15);
}

TEST(Illuminance, FarFromTheHoleIsLamberts) {
  const Point light{1e9, 0.0, 0.0};
  const Point point{1e9, 3e8, 4e8};
  const Point normal{0.0, -1.0, 0.0};
  EXPECT_NEAR(illuminance(light, point, normal, 1, 2.5e17), 0.6, 1e-6);
}

TEST(Tessellation, GrowsWithTheCurvatureOfAnEdge) {
  // The middle point of the edge is off the line between its ends by half of the line's length. The
  // curvature is 1/2 (eq. 18), and the level (eq. 19 with a = 5, b = 0.75) is limited to its
  // maximum.
  EXPECT_DOUBLE_EQ(apparent_curvature({0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}), 0.5);
  EXPECT_EQ(apparent_curvature({1.0, 1.0}, {2.0, 1.0}, {1.0, 1.0}), 0.0);
  const TessellationSettings settings;
  EXPECT_EQ(tessellation_level(0.0, settings), 1.0);
  EXPECT_EQ(tessellation_level(0.5, settings), 64.0);
  EXPECT_DOUBLE_EQ(tessellation_level(0.0081, {64.0, 5.0, 0.5}), 64.0 * 5.0 * 0.09);
}

TEST(Tessellation, TrianglesWithThePointBehindTheHoleAreTorn) {
  // The rod of figure 6 in Müller, Schulz & Weiskopf: two points that are on opposite sides of the
  // line behind the hole appear on opposite sides of the hole.
  const Point observer{40.0, 0.0, 0.0};
  const auto screen = [](const Point& direction) {
    return ScreenPoint{direction.y / -direction.x, direction.z / -direction.x};
  };
  const auto torn = [&](const std::array<Point, 3>& corners) {
    ScreenPoint seen[3];
    ScreenPoint straight[3];
    for (int i = 0; i < 3; ++i) {
      const Point& corner = corners[static_cast<std::size_t>(i)];
      seen[i] = screen(apparent_position(observer, corner, 1).direction);
      straight[i] = screen(corner - observer);
    }
    return is_torn(seen, straight, 3.0);
  };
  EXPECT_TRUE(torn({Point{-5.0, 0.2, 0.1}, {-5.0, -0.2, 0.1}, {-5.0, 0.0, -0.2}}));
  EXPECT_FALSE(torn({Point{-5.0, 3.2, 0.1}, {-5.0, 2.8, 0.1}, {-5.0, 3.0, -0.2}}));
}

}  // namespace
}  // namespace ergodome
