#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/core/angles.h"
#include "kernels/mesh/light_ray.h"
#include "kernels/mesh/mesh_emitter.h"
#include "tests/kernels/mesh_scene.h"
#include "tests/kernels/reference_tables.h"

// What light from and to meshes is like: shift, lamps, shadows, light travel time.
namespace ergodome::test {
namespace {

//! A point by pseudo-Cartesian spherical coordinates.
Vector3<double> point_at(double r, double theta, double phi) {
  return {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
}

//! The equatorial plane out to r = 64.
TriangleMesh plane() {
  constexpr float far = 64.0F;
  TriangleMesh square;
  for (const auto& [x, y] : {std::pair{-far, -far}, {far, -far}, {far, far}, {-far, far}}) {
    square.vertices.push_back({{x, y, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F}});
  }
  square.indices = {0, 1, 2, 0, 2, 3};
  return square;
}

TEST(MeshEmitter, OnAKeplerianOrbitShiftsLightAsTheReferenceTableHasIt) {
  const Placed placed(plane(), {0.0, 0.0, 0.0}, 1.0);
  int compared = 0;
  for (const ReferenceCrossing& row : reference_crossings()) {
    if (row.order != 0 || row.r_hit > 60.0 || row.r > 1e4 || std::abs(row.theta - 0.5 * pi) < 1e-12 ||
        !(row.g_kepler > 0.0)) {
      continue;
    }
    const CameraStation camera = station_of(row);
    const NearRay<double> ray = start_near_ray(camera, row.n);
    const MeshHit hit = look(camera, row.n, {&placed.mesh, 1, horizon_radius(row.a) * 1.0001, 100.0});
    ASSERT_EQ(hit.mesh, 0) << row.id;
    const double r = length(hit.point);
    const double rate = 1.0 / (r * std::sqrt(r) + row.a);
    const Vector3<double> velocity = {-rate * hit.point.y, rate * hit.point.x, 0.0};
    const double frequency = emitted_frequency(row.a, hit, ray.energy, ray.axial_angular_momentum, velocity);
    EXPECT_NEAR(frequency * row.g_kepler, 1.0, 1e-8) << row.id;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

//! A ray from a camera about a spinning hole to a small ball, and what it hits.
struct SeenBall {
  CameraStation camera = make_camera_station(0.9, 20.0, 1.1, 0.4, ObserverMotion::zamo);
  Placed ball;
  NearRay<double> ray;
  MeshHit hit;

  explicit SeenBall(double r) : ball(make_sphere({}), point_at(r, 1.1, 0.4), 0.5 * (r - 1.5)) {
    const Vector3<double> n = {-1.0, 0.0, 0.0};
    ray = start_near_ray(camera, n);
    hit = look(camera, n, {&ball.mesh, 1, 1.45, 25.0});
  }
};

TEST(MeshEmitter, AtRestInSchwarzschildShiftsLightByBothLapses) {
  const CameraStation camera = make_camera_station(0.0, 30.0, 1.0, 0.0, ObserverMotion::fixed);
  const Placed ball(make_sphere({}), point_at(7.0, 1.3, 0.8), 1.0);
  const ApparentPlace seen = apparent_place(point_at(30.0, 1.0, 0.0), point_at(7.0, 1.3, 0.8), 2);
  const LocalFrame frame = local_frame(0.0, point_at(30.0, 1.0, 0.0));
  const Vector3<double> n = in_axes(frame, seen.direction);
  const MeshHit hit = look(camera, n, {&ball.mesh, 1, 5.5, 8.5});
  ASSERT_EQ(hit.mesh, 0);
  const NearRay<double> ray = start_near_ray(camera, n);
  const double frequency = emitted_frequency(0.0, hit, ray.energy, ray.axial_angular_momentum, {0.0, 0.0, 0.0});
  EXPECT_NEAR(1.0 / frequency, static_frequency_ratio(length(hit.point), 30.0), 1e-12);
}

TEST(MeshEmitter, ThatTurnsWithSpaceIsAnObserverWithoutAngularMomentum) {
  const SeenBall seen(6.0);
  ASSERT_EQ(seen.hit.mesh, 0);
  const double r = length(seen.hit.point);
  const double theta = std::acos(seen.hit.point.z / r);
  const double rate = kerr_functions(0.9, r, theta).frame_dragging;
  const double frequency = emitted_frequency(0.9, seen.hit, seen.ray.energy, seen.ray.axial_angular_momentum,
                                             {-rate * seen.hit.point.y, rate * seen.hit.point.x, 0.0});
  EXPECT_NEAR(
      frequency,
      zamo_frequency(0.9, r, std::sin(theta), std::cos(theta), seen.ray.energy, seen.ray.axial_angular_momentum),
      1e-12);
}

TEST(MeshEmitter, ThatWouldOutrunLightIsTakenForOneThatTurnsWithSpace) {
  const SeenBall seen(6.0);
  const auto frequency = [&](const Vector3<double>& velocity) {
    return emitted_frequency(0.9, seen.hit, seen.ray.energy, seen.ray.axial_angular_momentum, velocity);
  };
  EXPECT_EQ(frequency({0.0, 0.0, 5.0}), frequency({3.0, 0.0, 0.0}));
  EXPECT_GT(frequency({0.0, 0.0, 5.0}), 0.0);
}

//! A point, a lamp, and the closed form's light without spin between them.
struct LitPoint {
  Vector3<double> point, lamp;
};

std::vector<LitPoint> lit_points() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto place = [&](double least, double most) {
    return point_at(least + (most - least) * share(random), std::acos(2.0 * share(random) - 1.0),
                    2.0 * pi * share(random));
  };
  std::vector<LitPoint> points;
  for (int i = 0; i < 40; ++i) {
    const Vector3<double> point = place(3.5, 20.0);
    points.push_back({point, place(3.5, 60.0)});
  }
  return points;
}

bool ray_of(double spin, const Vector3<double>& point, const Vector3<double>& lamp, int order, LightRay& ray) {
  Vector3<double> correction = {0.0, 0.0, 0.0};
  return light_ray(spin, local_frame(spin, point), point, lamp, order, correction, ray);
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
    for (const double spin : {0.5, -0.998}) {
      const LocalFrame frame = local_frame(spin, at.point);
      LightRay ray{};
      ASSERT_TRUE(ray_of(spin, at.point, at.lamp, 1, ray));
      const Placed lamp(make_sphere({}), at.lamp, 5e-3);
      const double r = length(at.lamp);
      const MeshHit hit = look(frame.camera, ray.direction, {&lamp.mesh, 1, r - 0.01, r + 0.01});
      ASSERT_EQ(hit.mesh, 0) << spin;
      EXPECT_NEAR(hit.delay, ray.travel_time, 1e-2);
      ++met;
    }
  }
  EXPECT_EQ(met, 80);
}

TEST(LightRay, IsTheSameWhateverIsGuessed) {
  for (const LitPoint& at : lit_points()) {
    LightRay one{};
    LightRay other{};
    ASSERT_TRUE(ray_of(0.9, at.point, at.lamp, 1, one));
    Vector3<double> guess = {0.02, -0.01, 0.02};
    ASSERT_TRUE(light_ray(0.9, local_frame(0.9, at.point), at.point, at.lamp, 1, guess, other));
    EXPECT_LT(length(one.direction - other.direction), 1e-4);
  }
}

TEST(LightRay, TakesAsLongBackwardsAboutAHoleThatSpinsTheOtherWay) {
  for (const LitPoint& at : lit_points()) {
    LightRay there{};
    LightRay back{};
    ASSERT_TRUE(ray_of(0.9, at.point, at.lamp, 1, there));
    ASSERT_TRUE(ray_of(-0.9, at.lamp, at.point, 1, back));
    EXPECT_NEAR(there.travel_time, back.travel_time, 2e-5 * there.travel_time);
  }
}

//! A surface at a point, facing outwards, lit by a lamp among meshes.
double illuminance_of(double spin, const LitPoint& at, const Vector3<double>& normal, const MeshScene& scene) {
  Vector3<double> correction = {0.0, 0.0, 0.0};
  const LampLight light =
      lamp_light(spin, {at.lamp, 100.0}, at.point, normal, at.point + 1e-6 * normal, scene, {1e-10, 4000}, correction);
  return illuminance(light, normal);
}

TEST(LampLight, WithoutSpinAndShadowsIsTheClosedFormsOfBothWaysRound) {
  const Placed elsewhere(make_sphere({}), {0.0, 0.0, 90.0}, 1.0);
  for (const LitPoint& at : lit_points()) {
    const Vector3<double> normal = (1.0 / length(at.point)) * at.point;
    const double both =
        illuminance(at.lamp, at.point, normal, 1, 100.0) + illuminance(at.lamp, at.point, normal, 2, 100.0);
    EXPECT_NEAR(illuminance_of(0.0, at, normal, {&elsewhere.mesh, 1, 88.0, 92.0}), both, 5e-4 * both + 1e-12);
  }
}

TEST(LampLight, IsTakenAwayByWhatStandsOnItsRayAndByNothingElse) {
  const LitPoint at = {{10.0, 0.0, 0.0}, {30.0, 25.0, 3.0}};
  const Vector3<double> normal = {1.0, 0.0, 0.0};
  for (const double spin : {0.0, 0.9}) {
    const LocalFrame frame = local_frame(spin, at.point);
    LightRay ray{};
    ASSERT_TRUE(ray_of(spin, at.point, at.lamp, 1, ray));
    // Where the ray has come to after a third of its way.
    const Placed shell(make_sphere({}), {0.0, 0.0, 0.0}, 18.0);
    const MeshHit on_way = look(frame.camera, ray.direction, {&shell.mesh, 1, 17.0, 19.0});
    ASSERT_EQ(on_way.mesh, 0);
    const Placed before(make_sphere({}), on_way.point, 0.5);
    const Placed beside(make_sphere({}), on_way.point + Vector3<double>{0.0, 0.0, 0.6}, 0.5);
    const double free = illuminance_of(spin, at, normal, {&beside.mesh, 1, 15.0, 20.0});
    EXPECT_GT(free, 0.0);
    // The second way round the hole is another, and much weaker.
    EXPECT_LT(illuminance_of(spin, at, normal, {&before.mesh, 1, 15.0, 20.0}), 0.01 * free) << spin;
  }
}

TEST(LampLight, IsNotTakenAwayByWhatStandsBehindTheLamp) {
  const LitPoint at = {{10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}};
  const Placed behind(make_sphere({}), {24.0, 0.0, 0.0}, 2.0);
  EXPECT_GT(illuminance_of(0.0, at, {1.0, 0.0, 0.0}, {&behind.mesh, 1, 20.0, 27.0}), 0.0);
}

TEST(LampLight, ReachesASurfaceThatFacesAwayRoundTheHoleAlone) {
  const LitPoint at = {{10.0, 0.0, 0.0}, {30.0, 0.0, 0.1}};
  const Placed elsewhere(make_sphere({}), {0.0, 0.0, 90.0}, 1.0);
  const MeshScene scene = {&elsewhere.mesh, 1, 88.0, 92.0};
  const double round = illuminance(at.lamp, at.point, {-1.0, 0.0, 0.0}, 2, 100.0);
  EXPECT_GT(round, 0.0);
  // The rays go to 1e-6 off the surface.
  EXPECT_NEAR(illuminance_of(0.0, at, {-1.0, 0.0, 0.0}, scene), round, 1e-6 * round);
}

TEST(LampLight, RoundTheHoleMeetsNothingThatItPasses) {
  // It comes back past where it set out, 5 M beside the ball that a place a hundredth off the surface would send it into.
  const LitPoint at = {{13.0, 0.0, 0.0}, {40.0, 0.0, 0.0}};
  const Placed ball(make_sphere({}), {15.0, 0.0, 0.0}, 1.99);
  const MeshScene scene = {&ball.mesh, 1, 12.0, 18.0};
  for (const double off : {1e-6, 1e-2}) {
    Vector3<double> correction = {0.0, 0.0, 0.0};
    const Vector3<double> inward = {-1.0, 0.0, 0.0};
    const LampLight light = lamp_light(0.0, {at.lamp, 100.0}, at.point + Vector3<double>{0.0, 0.01, 0.0}, inward,
                                       at.point + Vector3<double>{-off, 0.01, 0.0}, scene, {1e-10, 4000}, correction);
    EXPECT_GT(light.strength[1], 0.0) << off;
  }
}

TEST(RetardedMesh, IsMetWhereItWasWhenItsLightLeft) {
  const CameraStation camera = make_camera_station(0.6, 30.0, 1.2, 0.3, ObserverMotion::zamo);
  Placed moving(make_sphere({}), point_at(9.0, 0.5 * pi, 0.3), 1.5);
  const Vector3<double> toward = moving.mesh.position;
  moving.mesh.orbit = {toward, {-toward.y, toward.x, 0.0}, 1.0 / 27.0};
  moving.mesh.retarded = true;
  int met = 0;
  for (int i = -12; i <= 12; ++i) {
    for (int k = -6; k <= 6; ++k) {
      const Vector3<double> n = {-1.0, 0.02 * k, 0.03 * i};
      const Vector3<double> unit = (1.0 / length(n)) * n;
      const MeshHit hit = look(camera, unit, {&moving.mesh, 1, 7.0, 11.0});
      if (hit.mesh < 0) {
        continue;
      }
      Placed there(make_sphere({}), mesh_position(moving.mesh, hit.delay), 1.5);
      const MeshHit again = look(camera, unit, {&there.mesh, 1, 7.0, 11.0});
      ASSERT_EQ(again.mesh, 0);
      // A ball that comes along the ray may be met elsewhere first.
      if (std::abs(again.delay - hit.delay) < 1.0) {
        EXPECT_LT(length(again.point - hit.point), 1e-8);
        ++met;
      }
    }
  }
  EXPECT_GT(met, 10);
  EXPECT_GT(length(mesh_position(moving.mesh, 20.0) - moving.mesh.position), 5.0);
}

}  // namespace
}  // namespace ergodome::test
