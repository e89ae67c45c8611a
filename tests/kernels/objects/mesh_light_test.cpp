#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/objects/local_frame.h"
#include "kernels/objects/mesh_emitter.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "tests/kernels/lit_points.h"
#include "tests/kernels/mesh_scene.h"
#include "tests/kernels/reference_tables.h"

// Tests of light from meshes: frequency shift and travel time.
namespace ergodome::test {
namespace {

//! Returns a square mesh in the equatorial plane, which extends to x, y = ±64.
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
    const MeshHit hit = first_hit(camera, row.n, {&placed.mesh, 1, horizon_radius(Spacetime{row.a}) * 1.0001, 100.0});
    ASSERT_EQ(hit.mesh, 0) << row.id;
    const double r = length(hit.point);
    const double rate = 1.0 / (r * std::sqrt(r) + row.a);
    const Vector3<double> velocity = {-rate * hit.point.y, rate * hit.point.x, 0.0};
    const double frequency = emitted_frequency(Spacetime{row.a}, hit, ray.energy, ray.axial_angular_momentum, velocity);
    EXPECT_NEAR(frequency * row.g_kepler, 1.0, 1e-8) << row.id;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

//! A camera near a spinning hole, a small ball, and a ray that hits the ball.
struct SeenBall {
  CameraStation camera = make_camera_station(Spacetime{0.9}, 20.0, 1.1, 0.4, ObserverMotion::zamo);
  Placed ball;
  NearRay<double> ray;
  MeshHit hit;

  explicit SeenBall(double r) : ball(make_sphere({}), point_at(r, 1.1, 0.4), 0.5 * (r - 1.5)) {
    const Vector3<double> n = {-1.0, 0.0, 0.0};
    ray = start_near_ray(camera, n);
    hit = first_hit(camera, n, {&ball.mesh, 1, 1.45, 25.0});
  }
};

TEST(MeshEmitter, AtRestInSchwarzschildShiftsLightByBothLapses) {
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 30.0, 1.0, 0.0, ObserverMotion::fixed);
  const Placed ball(make_sphere({}), point_at(7.0, 1.3, 0.8), 1.0);
  const ApparentPosition seen = apparent_position(point_at(30.0, 1.0, 0.0), point_at(7.0, 1.3, 0.8), 2);
  const LocalFrame frame = local_frame(Spacetime{0.0}, point_at(30.0, 1.0, 0.0));
  const Vector3<double> n = in_axes(frame, seen.direction);
  const MeshHit hit = first_hit(camera, n, {&ball.mesh, 1, 5.5, 8.5});
  ASSERT_EQ(hit.mesh, 0);
  const NearRay<double> ray = start_near_ray(camera, n);
  const double frequency =
      emitted_frequency(Spacetime{0.0}, hit, ray.energy, ray.axial_angular_momentum, {0.0, 0.0, 0.0});
  EXPECT_NEAR(1.0 / frequency, static_frequency_ratio(length(hit.point), 30.0), 1e-12);
}

TEST(MeshEmitter, ThatTurnsWithSpaceIsAnObserverWithoutAngularMomentum) {
  const SeenBall seen(6.0);
  ASSERT_EQ(seen.hit.mesh, 0);
  const double r = length(seen.hit.point);
  const double theta = std::acos(seen.hit.point.z / r);
  const double rate = kerr_functions(Spacetime{0.9}, r, theta).frame_dragging;
  const double frequency = emitted_frequency(Spacetime{0.9}, seen.hit, seen.ray.energy, seen.ray.axial_angular_momentum,
                                             {-rate * seen.hit.point.y, rate * seen.hit.point.x, 0.0});
  EXPECT_NEAR(
      frequency,
      zamo_frequency(0.9, r, std::sin(theta), std::cos(theta), seen.ray.energy, seen.ray.axial_angular_momentum),
      1e-12);
}

TEST(MeshEmitter, ThatWouldOutrunLightIsTakenForOneThatTurnsWithSpace) {
  const SeenBall seen(6.0);
  const auto frequency = [&](const Vector3<double>& velocity) {
    return emitted_frequency(Spacetime{0.9}, seen.hit, seen.ray.energy, seen.ray.axial_angular_momentum, velocity);
  };
  EXPECT_EQ(frequency({0.0, 0.0, 5.0}), frequency({3.0, 0.0, 0.0}));
  EXPECT_GT(frequency({0.0, 0.0, 5.0}), 0.0);
}

TEST(RetardedMesh, IsMetWhereItWasWhenItsLightLeft) {
  const CameraStation camera = make_camera_station(Spacetime{0.6}, 30.0, 1.2, 0.3, ObserverMotion::zamo);
  Placed moving(make_sphere({}), point_at(9.0, 0.5 * pi, 0.3), 1.5);
  const Vector3<double> toward = moving.mesh.position;
  moving.mesh.orbit = {toward, {-toward.y, toward.x, 0.0}, 1.0 / 27.0};
  moving.mesh.retarded = true;
  int met = 0;
  for (int i = -12; i <= 12; ++i) {
    for (int k = -6; k <= 6; ++k) {
      const Vector3<double> n = {-1.0, 0.02 * k, 0.03 * i};
      const Vector3<double> unit = (1.0 / length(n)) * n;
      const MeshHit hit = first_hit(camera, unit, {&moving.mesh, 1, 7.0, 11.0});
      if (hit.mesh < 0) {
        continue;
      }
      Placed there(make_sphere({}), mesh_position(moving.mesh, hit.delay), 1.5);
      const MeshHit again = first_hit(camera, unit, {&there.mesh, 1, 7.0, 11.0});
      ASSERT_EQ(again.mesh, 0);
      // The ray may first meet another point of a ball that moves along the ray; such rays are
      // skipped.
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
