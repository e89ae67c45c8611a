#include "kernels/objects/light_ray.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "kernels/core/angles.h"
#include "tests/kernels/lit_points.h"
#include "tests/kernels/mesh_scene.h"
#include "tests/kernels/reference_tables.h"

// Tests of light between a lamp and a point: its path, its travel time, and how a bundle of rays
// spreads.
namespace ergodome::test {
namespace {

bool ray_of(double spin, const Vector3<double>& point, const Vector3<double>& lamp, int order, LightRay& ray) {
  RayCorrection correction = {};
  return light_ray(Spacetime{spin}, local_frame(Spacetime{spin}, point), point, lamp, order, LightRayParts::way,
                   correction, ray);
}

TEST(LightRay, FoundByNewtonsMethodIsTheClosedFormsWhereSpinIsNegligible) {
  for (const LitPoint& at : lit_points()) {
    for (const int order : {1, 2}) {
      LightRay exact{};
      LightRay found{};
      ASSERT_TRUE(ray_of(0.0, at.point, at.lamp, order, exact));
      ASSERT_TRUE(ray_of(1e-9, at.point, at.lamp, order, found)) << order;
      EXPECT_LT(length(found.direction - exact.direction), 1e-4);
      EXPECT_NEAR(found.travel_time, exact.travel_time, 1e-4 * exact.travel_time);
    }
  }
}

TEST(LightRay, LeadsToTheLampPastAHoleThatSpins) {
  int met = 0;
  for (const LitPoint& at : lit_points()) {
    for (const auto& [spin, order] : {std::pair{0.5, 1}, {0.5, 2}, {-0.998, 1}, {-0.9, 2}}) {
      const LocalFrame frame = local_frame(Spacetime{spin}, at.point);
      LightRay ray{};
      ASSERT_TRUE(ray_of(spin, at.point, at.lamp, order, ray)) << spin;
      const Placed lamp(make_sphere({}), at.lamp, 5e-3);
      const double r = length(at.lamp);
      const MeshHit hit = first_hit(frame.camera, ray.direction, {&lamp.mesh, 1, r - 0.01, r + 0.01});
      ASSERT_EQ(hit.mesh, 0) << spin;
      EXPECT_NEAR(hit.delay, ray.travel_time, 1e-2);
      ++met;
    }
  }
  EXPECT_EQ(met, 160);
}

TEST(LightRay, IsTheSameWhateverIsGuessed) {
  for (const LitPoint& at : lit_points()) {
    LightRay one{};
    LightRay other{};
    ASSERT_TRUE(ray_of(0.9, at.point, at.lamp, 1, one));
    RayCorrection guess = {{0.02, -0.01, 0.02}, 0.0, 0.0};
    ASSERT_TRUE(light_ray(Spacetime{0.9}, local_frame(Spacetime{0.9}, at.point), at.point, at.lamp, 1,
                          LightRayParts::way, guess, other));
    EXPECT_LT(length(one.direction - other.direction), 1e-4);
  }
}

TEST(LightRay, TakesAsLongBackwardsAboutAHoleThatSpinsTheOtherWay) {
  for (const LitPoint& at : lit_points()) {
    LightRay there{};
    LightRay back{};
    ASSERT_TRUE(ray_of(0.9, at.point, at.lamp, 1, there));
    ASSERT_TRUE(ray_of(-0.9, at.lamp, at.point, 1, back));
    // The travel time is that of the next-to-last step of Newton's method, whose ray ends up to
    // 2e-4 rad from the point.
    EXPECT_NEAR(there.travel_time, back.travel_time, 1e-4 * there.travel_time);
  }
}

//! Returns the spread of a bundle from a lamp around a hole without spin, r² r_L² b |du/dφ|
//! |du_L/dφ| sinψ |dψ/db|: r is the radius of the lit point, r_L that of the lamp, u and u_L are
//! their inverses, b is the ray's impact parameter, and ψ the angle that it sweeps about the hole.
//! The derivative dψ/db is computed by differences of the closed form.
double closed_spread(const LitPoint& at, int order) {
  const ConnectionPlane plane = connection_plane(at.lamp, at.point);
  const double angle = image_angle(plane.phi, order);
  constexpr double apart = 1e-5;
  const auto ray = [&](double more) { return connecting_ray(plane.r_observer, plane.r, angle + more); };
  const double rate = (ray(apart).impact_parameter - ray(-apart).impact_parameter) / (2.0 * apart);
  const ConnectingRay middle = ray(0.0);
  return std::pow(plane.r_observer * plane.r, 2) * middle.impact_parameter *
         std::abs(middle.rate_at_observer * middle.rate_at_point * std::sin(angle) / rate);
}

LightRay spread_of(double spin, const LitPoint& at, int order) {
  RayCorrection correction = {};
  LightRay ray{};
  EXPECT_TRUE(light_ray(Spacetime{spin}, local_frame(Spacetime{spin}, at.point), at.point, at.lamp, order,
                        LightRayParts::spread, correction, ray));
  return ray;
}

TEST(LightRay, SpreadsWithoutSpinAsTheClosedFormHasIt) {
  for (const LitPoint& at : lit_points()) {
    for (const int order : {1, 2}) {
      const double expected = closed_spread(at, order);
      EXPECT_NEAR(spread_of(0.0, at, order).spread, expected, 1e-5 * expected) << order;
    }
  }
}

//! A visitor that finds where a ray from a lamp first crosses a radius, in the requested direction
//! (inward or outward), and the time of this crossing.
struct Crossing {
  Vector3<double> position{};
  double time = 0.0;
  bool found = false;
  bool outward = false;

  void cross(int, bool lanes, const NearPosition<double>& at) {
    if (!lanes || found || (at.u_rate < 0.0) != outward) {
      return;
    }
    const double c = std::cos(at.drag);
    const double s = std::sin(at.drag);
    position = {c * at.m.x - s * at.m.y, s * at.m.x + c * at.m.y, at.m.z};
    time = at.delay;
    found = true;
  }
  static void turn(bool, const NearPosition<double>&) {}
  [[nodiscard]] static bool done() { return false; }
};

//! Returns the cross-section of a bundle divided by its solid angle and by the square of its
//! energy. The bundle consists of five rays from the lamp, and differences of their ends give its
//! cross-section in the frame of a zero-angular-momentum observer at the point. Traces from the
//! lamp in time-reversed spacetime, even if the point is closer to the hole.
double spread_by_differences(double spin, const LitPoint& at, const Vector3<double>& emitted, const LightRay& ray) {
  const LocalFrame lamp = local_frame(Spacetime{-spin}, at.lamp);
  const double r = length(at.point);
  const double u = 1.0 / r;
  Vector3<double> across[2];
  detail::axes_across(emitted, across[0], across[1]);
  constexpr double apart = 1e-6;
  std::array<std::array<Crossing, 2>, 2> ends;
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      const Vector3<double> n = emitted + ((k == 0 ? apart : -apart) * across[i]);
      ends[i][k].outward = ray.direction.x < 0.0;
      trace_shells<20, NearParts::azimuth_and_delay>(-spin, start_near_ray(lamp.camera, (1.0 / length(n)) * n), {&u, 1},
                                                     {1e-15, 100'000}, true, ends[i][k]);
      EXPECT_TRUE(ends[i][k].found);
    }
  }
  const double theta = std::acos(at.point.z / r);
  const KerrFunctions f = kerr_functions(Spacetime{-spin}, r, theta);
  const auto separation = [&](const std::array<Crossing, 2>& two) {
    const auto azimuth = [](const Vector3<double>& v) { return std::atan2(v.y, v.x); };
    const double by = 0.5 / apart;
    const double along_theta = by * (std::acos(two[0].position.z) - std::acos(two[1].position.z));
    const double along_phi = by * std::remainder(azimuth(two[0].position) - azimuth(two[1].position), 2.0 * pi);
    // Rays are traced backwards in time, so the time difference has the opposite sign.
    const double along_time = -by * (two[0].time - two[1].time);
    return Vector3<double>{0.0, std::sqrt(f.sigma) * along_theta,
                           f.circumference_factor * std::sin(theta) * (along_phi - f.frame_dragging * along_time)};
  };
  const double energy = detail::evaluate(lamp.camera.energy, emitted);
  return std::abs(dot(ray.direction, cross(separation(ends[0]), separation(ends[1])))) * energy * energy;
}

TEST(LightRay, SpreadsAboutAHoleThatSpinsAsBundlesFromTheLampDo) {
  int compared = 0;
  for (const LitPoint& at : lit_points()) {
    for (const auto& [spin, order] : {std::pair{0.5, 1}, {-0.998, 1}, {0.9, 2}}) {
      const LightRay ray = spread_of(spin, at, order);
      if (std::abs(ray.direction.x) < 0.05) {
        continue;  // The ray grazes the sphere on which the neighbors are intersected.
      }
      // Finds the direction in which the ray leaves the lamp: in time-reversed spacetime, it is the
      // direction in which an observer at the lamp sees light from the point.
      RayCorrection correction = {};
      LightRay back{};
      const LocalFrame lamp = local_frame(Spacetime{-spin}, at.lamp);
      ASSERT_TRUE(light_ray(Spacetime{-spin}, lamp, at.lamp, at.point, order, LightRayParts::way, correction, back));
      const double expected = spread_by_differences(spin, at, back.direction, ray);
      EXPECT_NEAR(ray.spread, expected, 2e-3 * expected) << spin << ' ' << order;
      ++compared;
    }
  }
  EXPECT_GT(compared, 110);
}

TEST(LightRay, SpreadsTheSameBothWays) {
  for (const LitPoint& at : lit_points()) {
    for (const int order : {1, 2}) {
      const double there = spread_of(0.9, at, order).spread;
      EXPECT_NEAR(spread_of(-0.9, {at.lamp, at.point}, order).spread, there, 1e-3 * there) << order;
    }
  }
}

// Compares both sides of a limit on the distance: below it, Newton's method is not accurate and an
// approximation for short paths replaces it.
TEST(LightRay, AcrossShortWaysAboutAHoleThatSpinsComesFromWhereItDoesAcrossLongerOnes) {
  for (const double r : {4.0, 20.0}) {
    const Vector3<double> point = {r, 0.0, 0.1};
    LightRay rays[2] = {};
    for (int i = 0; i < 2; ++i) {
      const double distance = (i == 0 ? 2.9e-3 : 3.1e-3) * r;
      rays[i] = spread_of(0.9, {point, point + Vector3<double>{0.3 * distance, distance, 0.0}}, 1);
      rays[i].spread /= distance * distance;
    }
    EXPECT_LT(length(rays[0].direction - rays[1].direction), 1e-3) << r;
    EXPECT_NEAR(rays[0].spread, rays[1].spread, 0.01 * rays[1].spread) << r;
  }
}

TEST(LightRay, SpreadsAcrossShortWaysAsThoughSpaceWereFlat) {
  for (const double r : {5.0, 100.0, 1e5}) {
    for (const double part : {2.9e-3, 3.1e-3}) {
      const double distance = part * r;
      const LitPoint at = {{r, 0.0, 0.0}, {r - 0.3 * distance, distance, 0.0}};
      const double expected = closed_spread(at, 1);
      EXPECT_NEAR(spread_of(0.0, at, 1).spread, expected, 2e-3 * expected) << r << ' ' << part;
    }
  }
}

// Tests lamps behind the hole, where the two paths meet and one could be mistaken for the other.
TEST(LightRay, BehindAHoleThatSpinsComesBothWaysOnOppositeSides) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int found = 0;
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const double spin = 0.3 + 0.7 * share(random);
    const Vector3<double> lamp = point_at(8.0 + 40.0 * share(random), std::acos(2.0 * share(random) - 1.0), 1.0);
    Vector3<double> across[2];
    const Vector3<double> away = (-1.0 / length(lamp)) * lamp;
    detail::axes_across(away, across[0], across[1]);
    const double off = 0.05 + 0.55 * share(random);
    const double side = 2.0 * pi * share(random);
    const Vector3<double> beside = std::cos(side) * across[0] + std::sin(side) * across[1];
    const Vector3<double> point = (4.0 + 30.0 * share(random)) * (std::cos(off) * away + std::sin(off) * beside);
    LightRay ways[2] = {};
    if (ray_of(spin, point, lamp, 1, ways[0]) && ray_of(spin, point, lamp, 2, ways[1])) {
      ++found;
      apart += dot(ways[0].direction, ways[1].direction) < 0.999 ? 1 : 0;
    }
  }
  EXPECT_GE(found, 297);
  EXPECT_EQ(apart, found);
}

TEST(LightRay, OfBothWaysChangesNoMoreThanTheSpinDoes) {
  for (const LitPoint& at : lit_points()) {
    for (const int order : {1, 2}) {
      const double still = spread_of(0.0, at, order).spread;
      EXPECT_NEAR(spread_of(1e-7, at, order).spread, still, 1e-4 * still) << order;
    }
  }
}

}  // namespace
}  // namespace ergodome::test
