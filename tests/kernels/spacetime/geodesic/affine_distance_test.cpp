#include "kernels/spacetime/geodesic/affine_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/eyes/flat/affine_distances.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/launch/launch.h"
#include "kernels/spacetime/shadow/critical_curve.h"

namespace ergodome {
namespace {

Vector3<double> random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Vector3<double> v = {normal(random), normal(random), normal(random)};
  return (1.0 / std::sqrt(dot(v, v))) * v;
}

//! Computes the affine distance by the fourth-order Runge-Kutta method in Mino time, for E = 1. The
//! equations are different from those of the Taylor series: r'' = R'(r) / 2 with R = (r² + a² - a
//! L)² - Δ K, and the same for cosθ.
double integrated_distance(const CameraStation& camera, const Vector3<double>& n, double r_end, double step) {
  const RayStart<double> ray = start_ray(camera, n);
  const double a = camera.spin;
  const double momentum = ray.axial_angular_momentum;
  const double carter = ray.polar_constant - momentum * momentum;
  struct State {
    double r, r_rate, z, z_rate, distance;
  };
  const auto rate = [&](const State& s) {
    const double x = s.r * s.r + a * a - a * momentum;
    const double r_force = 2.0 * s.r * x - (s.r - 1.0) * ray.shear_constant;
    const double z_force = -(carter + momentum * momentum - a * a) * s.z - 2.0 * a * a * s.z * s.z * s.z;
    return State{s.r_rate, r_force, s.z_rate, z_force, s.r * s.r + a * a * s.z * s.z};
  };
  const auto moved = [](const State& s, double h, const State& d) {
    return State{s.r + h * d.r, s.r_rate + h * d.r_rate, s.z + h * d.z, s.z_rate + h * d.z_rate,
                 s.distance + h * d.distance};
  };
  const double r0 = 1.0 / camera.u;
  State s = {r0, -r0 * r0 * ray.u_rate, ray.m.z, ray.m_rate.z, 0.0};
  const double side = r_end < r0 ? 1.0 : -1.0;
  for (int i = 0; i < 4'000'000; ++i) {
    const double h = step / s.r;
    const State k1 = rate(s);
    const State k2 = rate(moved(s, 0.5 * h, k1));
    const State k3 = rate(moved(s, 0.5 * h, k2));
    const State k4 = rate(moved(s, h, k3));
    State next = s;
    next = moved(next, h / 6.0, k1);
    next = moved(next, h / 3.0, k2);
    next = moved(next, h / 3.0, k3);
    next = moved(next, h / 6.0, k4);
    if (side * (next.r - r_end) <= 0.0) {
      const double part = (s.r - r_end) / (s.r - next.r);
      return (s.distance + part * (next.distance - s.distance)) / ray.energy;
    }
    s = next;
  }
  return -1.0;
}

TEST(AffineDistance, IsThatOfAnIndependentIntegration) {
  std::mt19937_64 random(5);
  for (const double spin : {0.0, 0.7, 0.999}) {
    const CameraStation camera = make_camera_station(Spacetime{spin}, 7.0, 1.1, 0.0, ObserverMotion::geodesic);
    int captured = 0;
    for (int i = 0; i < 400 && captured < 6; ++i) {
      const Vector3<double> n = random_direction(random);
      if (direction_is_bright(camera, n)) {
        continue;
      }
      ++captured;
      const double expected = integrated_distance(camera, n, 1.02 * camera.horizon_r, 2e-4);
      EXPECT_NEAR(affine_distance(camera, n, 1.02 * camera.horizon_r), expected, 1e-5 * expected) << spin;
    }
    EXPECT_EQ(captured, 6);
  }
}

TEST(AffineDistance, ReachesShellsOnBothSides) {
  std::mt19937_64 random(6);
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 7.0, 1.1, 0.0, ObserverMotion::zamo);
  for (int i = 0; i < 6; ++i) {
    const Vector3<double> n = random_direction(random);
    if (direction_is_bright(camera, n)) {
      const double expected = integrated_distance(camera, n, 30.0, 1e-4);
      EXPECT_NEAR(affine_distance(camera, n, 30.0), expected, 1e-4 * expected);
    }
  }
}

TEST(AffineDistance, OfRadialLightIsTheCoordinatesOverTheEnergy) {
  for (const double r : {2.5, 6.0, 50.0}) {
    const CameraStation camera = make_camera_station(Spacetime{0.0}, r, 1.2, 0.0, ObserverMotion::zamo);
    const double energy = std::sqrt(1.0 - 2.0 / r);
    EXPECT_NEAR(affine_distance(camera, {-1.0, 0.0, 0.0}, 2.0), (r - 2.0) / energy, 1e-9 * r);
    EXPECT_NEAR(affine_distance(camera, {1.0, 0.0, 0.0}, 3.0 * r), 2.0 * r / energy, 1e-9 * r);
  }
}

TEST(AffineDistance, OfAFarCameraIsThatOfFlatSpace) {
  const double r = 1e7;
  const CameraStation camera = make_camera_station(Spacetime{0.9}, r, 1.0, 0.0, ObserverMotion::zamo);
  for (const double angle : {0.3, 0.8, 2.0, 3.0}) {
    // The shell has twice the radius of the camera. `angle` is measured from the outward direction.
    const double flat = -r * std::cos(angle) + std::sqrt(4.0 * r * r - std::pow(r * std::sin(angle), 2.0));
    const double distance =
        affine_distance(camera, {std::cos(angle), 0.6 * std::sin(angle), 0.8 * std::sin(angle)}, 2.0 * r);
    EXPECT_NEAR(distance, flat, 1e-5 * flat) << angle;
  }
}

TEST(AffineDistance, IsInfiniteWhereTheRayDoesNotCome) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 7.0, 1.0, 0.0, ObserverMotion::zamo);
  EXPECT_TRUE(std::isinf(affine_distance(camera, {1.0, 0.0, 0.0}, camera.horizon_r)));
  EXPECT_TRUE(std::isinf(affine_distance(camera, {std::cos(1.5), std::sin(1.5), 0.0}, 3.0)));
}

TEST(AffineDistance, GrowsByTheLogarithmTowardsTheShadowsEdge) {
  const CameraStation camera = make_camera_station(Spacetime{0.6}, 8.0, 1.3, 0.0, ObserverMotion::zamo);
  const ShadowChart chart = make_shadow_chart(camera);
  const double edge = edge_polar_angle(camera, chart, 1.0);
  const auto at = [&](double off) {
    const double alpha = edge * (1.0 - off);
    return affine_distance(camera, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), 1.0),
                           camera.horizon_r);
  };
  const double step = at(1e-5) - at(1e-4);
  EXPECT_GT(step, 1.0);
  EXPECT_NEAR(at(1e-7) - at(1e-6), step, 0.01 * step);
}

TEST(AffineDistance, IsANumberInsideTheErgosphere) {
  const CameraStation camera = make_camera_station(Spacetime{0.999}, 1.3, 0.5 * pi, 0.0, ObserverMotion::zamo);
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    const Vector3<double> n = random_direction(random);
    if (!direction_is_bright(camera, n)) {
      const double distance = affine_distance(camera, n, camera.horizon_r);
      EXPECT_GT(distance, 0.0);
      EXPECT_LT(distance, 1e4);
    }
  }
}

TEST(AffineDistance, IsTheSameForEveryInstructionSet) {
  std::mt19937_64 random(9);
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 7.0, 1.1, 0.0, ObserverMotion::zamo);
  const double r_end = 1.02 * camera.horizon_r;
  constexpr int count = 203;
  std::vector<double> parts[3];
  std::vector<double> expected;
  for (int i = 0; i < count; ++i) {
    const Vector3<double> n = random_direction(random);
    parts[0].push_back(n.x);
    parts[1].push_back(n.y);
    parts[2].push_back(n.z);
    expected.push_back(affine_distance(camera, n, r_end));
  }
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!has_instruction_set(set)) {
      continue;
    }
    std::vector<double> distance(count, -1.0);
    const AffineDistanceBatch batch = {
        camera, r_end, count, {parts[0].data(), parts[1].data(), parts[2].data()}, distance.data()};
    const auto kernel = cpu_kernel<AffineDistanceBatch>(set);
    kernel.run(batch, 0, kernel.calls(batch));
    int reached = 0;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      ASSERT_EQ(std::isfinite(distance[i]), std::isfinite(expected[i])) << i;
      if (std::isfinite(expected[i])) {
        ++reached;
        EXPECT_NEAR(distance[i], expected[i], 1e-9 * expected[i]) << i;
      }
    }
    EXPECT_GT(reached, 10);
    EXPECT_LT(reached, 190);
  }
}

TEST(FlatParallax, GoesThereAndBack) {
  std::mt19937_64 random(8);
  const Vector3<double> eye = {0.3, -0.1, 0.2};
  for (int i = 0; i < 20; ++i) {
    const Vector3<double> n = random_direction(random);
    const double distance = 0.5 + i;
    const Vector3<double> seen = seen_by_eye(n, distance, eye);
    // By flat geometry, the line of sight from the eye must end at the point `distance * n`.
    const Vector3<double> way = distance * n - eye;
    EXPECT_NEAR(std::sqrt(dot(cross(seen, way), cross(seen, way))), 0.0, 1e-12);
    const Vector3<double> back = seen_by_head(seen, distance, eye);
    EXPECT_NEAR(dot(back, n), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace ergodome
