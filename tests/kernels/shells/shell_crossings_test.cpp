#include "kernels/shells/shell_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/core/dual.h"
#include "kernels/shells/shell_emitter.h"
#include "kernels/spacetime/schwarzschild/null_orbit.h"
#include "tests/kernels/boyer_lindquist_walk.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome::test {
namespace {

constexpr NearLimits<double> finest = {1e-15, 100'000};

template <class T>
struct Found {
  int shell;
  NearPosition<T> position;
};

//! A visitor that collects the crossings of a ray with shells.
template <class T>
struct Collector {
  std::vector<Found<T>> found;
  int turns = 0;

  void cross(int shell, bool lanes, const NearPosition<T>& position) {
    if (lanes) {
      found.push_back({shell, position});
    }
  }
  void turn(bool lanes, const NearPosition<T>&) { turns += lanes ? 1 : 0; }
  [[nodiscard]] static bool done() { return false; }
};

template <class T = double>
std::vector<Found<T>> cross(const CameraStation& camera, const Vector3<T>& n, std::vector<double> radii) {
  std::ranges::sort(radii, std::greater<>());
  for (double& r : radii) {
    r = 1.0 / r;
  }
  Collector<T> collector;
  const NearRay<T> ray = start_near_ray(camera, n);
  EXPECT_TRUE((trace_shells<20, NearParts::azimuth_and_delay>(
      camera.spin, ray, {radii.data(), static_cast<int>(radii.size())}, finest, true, collector)));
  return collector.found;
}

//! Returns the direction from the center of a shell to a crossing on it; φ is 0 at the camera.
Vector3<double> direction_of(const NearPosition<double>& at) {
  const double c = std::cos(at.drag);
  const double s = std::sin(at.drag);
  return {c * at.m.x - s * at.m.y, s * at.m.x + c * at.m.y, at.m.z};
}

Vector3<double> on_sphere(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Vector3<double> unit(const Vector3<double>& v) { return (1.0 / length(v)) * v; }

TEST(ShellCrossings, AtARadiusWhereLightMeetsTheEquatorLieThereByTheReferenceTable) {
  // The table contains points in the equatorial plane, computed with 113 bits. A ray must cross a
  // shell of the same radius at the point of the table.
  for (const ReferenceCrossing& row : reference_crossings()) {
    double nearest = 1.0;
    double delay = 0.0;
    for (const Found<double>& each : cross(station_of(row), row.n, {row.r_hit})) {
      const double distance = length(direction_of(each.position) - on_sphere(0.5 * pi, row.phi_hit));
      if (distance < nearest) {
        nearest = distance;
        delay = each.position.delay;
      }
    }
    EXPECT_LT(nearest, 1e-8) << row.id;
    EXPECT_NEAR(delay, row.delay, 1e-8) << row.id;
  }
}

TEST(ShellCrossings, OfAVeryLargeShellAreTheReferenceTablesSky) {
  constexpr double r = 1e12;
  int compared = 0;
  for (const ReferenceRay& row : reference_rays()) {
    if (row.status != LightEnd::sky || row.r > 1e6) {
      continue;
    }
    const CameraStation camera = station_of(row);
    const std::vector<Found<double>> found = cross(camera, row.n, {r});
    ASSERT_EQ(found.size(), 1U) << row.id;
    // The shell has a large radius r. There, the direction still differs from the sky direction by
    // the impact parameter over r, and Mino time by 1/r.
    const double impact = std::sqrt(std::max(0.0, start_ray(camera, row.n).polar_constant));
    EXPECT_LT(length(direction_of(found[0].position) - row.sky), allowed_sky_error(row) + 1e-9 + 2.0 * impact / r)
        << row.id << " " << row.kind;
    const double energy = start_near_ray(camera, row.n).energy;
    EXPECT_NEAR(found[0].position.time * energy / row.mino_time, 1.0, 1e-8 + allowed_sky_error(row)) << row.id;
    ++compared;
  }
  EXPECT_GT(compared, 400);
}

TEST(ShellCrossings, OfLightThatTheTableHasFallIntoTheHoleMeetAShellAboveTheHorizonOnce) {
  int compared = 0;
  for (const ReferenceRay& row : reference_rays()) {
    const double horizon = horizon_radius(Spacetime{row.a});
    const double shell = horizon * (1.0 + 1e-6);
    if (row.status == LightEnd::horizon && row.r > shell * 1.001) {
      const std::vector<Found<double>> found = cross(station_of(row), row.n, {shell});
      ASSERT_EQ(found.size(), 1U) << row.id << " a " << row.a << " " << row.kind;
      EXPECT_GT(found[0].position.u_rate, 0.0) << row.id;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(ShellCrossings, WithoutSpinAreOnTheClosedFormsOrbitThatTurns) {
  constexpr double camera_r = 30.0;
  for (const double turn_r : {3.001, 3.5, 5.0, 9.0}) {
    const double turn = 1.0 / turn_r;
    const TurningOrbit orbit = turning_orbit(turn, 1.0 / 3.0 - turn, 0.5 - turn, 1.0);
    const double b = 1.0 / std::sqrt(orbit.inverse_b_squared);
    const double sine = b * std::sqrt(1.0 - 2.0 / camera_r) / camera_r;
    const CameraStation camera = make_camera_station(Spacetime{0.0}, camera_r, 0.5 * pi, 0.0, ObserverMotion::fixed);
    for (const double shell_r : {turn_r * 1.01, 12.0, 29.0}) {
      const auto found = cross(camera, Vector3<double>{-std::sqrt(1.0 - sine * sine), 0.0, sine}, {shell_r});
      ASSERT_EQ(found.size(), 2U) << turn_r;
      const OrbitLeg to_camera = leg_from_turn(orbit, turn - 1.0 / camera_r);
      const OrbitLeg to_shell = leg_from_turn(orbit, turn - 1.0 / shell_r);
      const auto tortoise = [](double r) { return r + 2.0 * std::log(0.5 * r - 1.0); };
      for (int i = 0; i < 2; ++i) {
        const double sign = i == 0 ? -1.0 : 1.0;
        const double angle = to_camera.angle + sign * to_shell.angle;
        EXPECT_LT(length(direction_of(found[static_cast<std::size_t>(i)].position) - on_sphere(0.5 * pi, angle)), 1e-8);
        const double path = tortoise(camera_r) - tortoise(turn_r) + sign * (tortoise(shell_r) - tortoise(turn_r));
        EXPECT_NEAR(found[static_cast<std::size_t>(i)].position.delay, path + to_camera.delay + sign * to_shell.delay,
                    1e-7);
      }
    }
  }
}

TEST(ShellCrossings, WithoutSpinAreOnTheClosedFormsOrbitThatFalls) {
  constexpr double camera_r = 30.0;
  const PlungingOrbit orbit = plunging_orbit(0.01);
  const double sine = std::sqrt((1.0 - 2.0 / camera_r) / orbit.inverse_b_squared) / camera_r;
  const CameraStation camera = make_camera_station(Spacetime{0.0}, camera_r, 0.5 * pi, 0.0, ObserverMotion::fixed);
  for (const double shell_r : {20.0, 3.0, 2.1, 2.0 * (1.0 + 1e-6)}) {
    const auto found = cross(camera, Vector3<double>{-std::sqrt(1.0 - sine * sine), sine, 0.0}, {shell_r});
    ASSERT_EQ(found.size(), 1U);
    const double far = 1.0 / camera_r - 1.0 / 3.0;
    const double near = 1.0 / shell_r - 1.0 / 3.0;
    const double angle = swept_angle(orbit, far, near, near - far);
    EXPECT_LT(length(direction_of(found[0].position) - on_sphere(0.5 * pi + angle, 0.0)), 1e-8) << shell_r;
  }
}

//! A camera and a direction that are numerically difficult.
struct HardRay {
  double spin, r, theta;
  Vector3<double> n;
};

std::vector<HardRay> hard_rays() {
  std::vector<HardRay> rays;
  for (const double spin : {0.0, 0.9, -0.9, 1.0, -1.0}) {
    const double horizon = horizon_radius(Spacetime{spin});
    for (const double r : {12.0, horizon * 1.2}) {
      for (const double theta : {0.0, 1e-3, 0.8, 0.5 * pi}) {
        for (const Vector3<double>& n : {Vector3<double>{-1.0, 0.0, 0.0},
                                         {-1.0, 0.3, 0.0},
                                         {-1.0, 0.35, 0.4},
                                         {-1.0, -0.2, -0.1},
                                         {0.4, 1.0, 0.0},
                                         {0.9, 0.1, -0.4}}) {
          rays.push_back({spin, r, theta, unit(n)});
        }
      }
    }
  }
  return rays;
}

TEST(ShellCrossings, AreWhereManySmallStepsInOtherCoordinatesFindThem) {
  int crossings = 0;
  for (const HardRay& hard : hard_rays()) {
    const CameraStation camera =
        make_camera_station(Spacetime{hard.spin}, hard.r, hard.theta, 0.0, ObserverMotion::zamo);
    const NearRay<double> ray = start_near_ray(camera, hard.n);
    for (const double shell_r : {horizon_radius(Spacetime{hard.spin}) * 1.05, 3.3, 14.0}) {
      const auto found = cross(camera, hard.n, {shell_r});
      const auto walked = walk_to_shell(hard.spin, ray, shell_r, 20.0);
      ASSERT_EQ(found.size(), walked.size())
          << hard.spin << " " << hard.r << " " << hard.theta << " " << shell_r << " " << hard.n.y << " " << hard.n.z;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const NearPosition<double>& at = found[i].position;
        const double grazing = 1.0 / std::min(1.0, 10.0 * std::abs(at.u_rate / at.u));
        EXPECT_LT(length(direction_of(at) - on_sphere(walked[i].theta, walked[i].phi)), 1e-8 * grazing)
            << hard.spin << " " << hard.r << " " << hard.theta << " " << shell_r << " " << hard.n.y << " " << hard.n.z;
        EXPECT_NEAR(at.delay, walked[i].delay, 1e-8 * grazing * (1.0 + std::abs(at.delay)));
        EXPECT_NEAR(at.time, walked[i].time, 1e-9 * grazing * (1.0 + at.time));
        ++crossings;
      }
    }
  }
  EXPECT_GT(crossings, 300);
}

TEST(ShellCrossings, JustAboveTheHorizonAreWhereManySmallStepsFindThem) {
  for (const double spin : {0.0, 0.9, -0.9, 0.999, 1.0, -1.0}) {
    const double shell_r = horizon_radius(Spacetime{spin}) * (1.0 + 1e-6);
    const CameraStation camera = make_camera_station(Spacetime{spin}, 8.0, 1.1, 0.0, ObserverMotion::zamo);
    for (const Vector3<double>& raw : {Vector3<double>{-1.0, 0.2, 0.1}, {-1.0, 0.0, 0.0}, {-1.0, -0.1, -0.2}}) {
      const Vector3<double> n = unit(raw);
      const auto found = cross(camera, n, {shell_r});
      const auto walked = walk_to_shell(spin, start_near_ray(camera, n), shell_r, 20.0);
      ASSERT_EQ(found.size(), 1U);
      ASSERT_EQ(walked.size(), 1U) << spin << " " << n.y;
      // Around an extremal hole, the azimuth by frame dragging reaches a million turns near the
      // horizon. The rounding of 1/r causes a relative uncertainty of 1e-9.
      const double part = std::abs(spin) < 1.0 ? 1e-9 : 5e-9;
      const double open = 1e-7 + part * std::abs(found[0].position.drag);
      EXPECT_LT(length(direction_of(found[0].position) - on_sphere(walked[0].theta, walked[0].phi)), open) << spin;
      EXPECT_NEAR(found[0].position.delay, walked[0].delay, part * found[0].position.delay) << spin;
    }
  }
}

TEST(ShellCrossings, OfSeveralShellsComeInTheOrderOfTheLightsPath) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 9.0, 1.0, 0.0, ObserverMotion::zamo);
  const auto found = cross(camera, unit(Vector3<double>{-1.0, 0.2, -0.9}), {12.0, 8.0, 7.0, 20.0});
  std::vector<int> order;
  for (std::size_t i = 0; i < found.size(); ++i) {
    order.push_back(found[i].shell);
    EXPECT_GT(found[i].position.time, i > 0 ? found[i - 1].position.time : 0.0);
    EXPECT_GT(found[i].position.delay, i > 0 ? found[i - 1].position.delay : 0.0);
  }
  // Shells are numbered from the outside, starting with 0.
  EXPECT_EQ(order, (std::vector<int>{2, 3, 3, 2, 1, 0}));
}

TEST(ShellCrossings, OfACameraOnAShellAreNoneWhereItStands) {
  for (const double spin : {0.0, 0.9}) {
    const CameraStation camera = make_camera_station(Spacetime{spin}, 8.0, 1.0, 0.0, ObserverMotion::zamo);
    const double own = 1.0 / camera.u;
    EXPECT_TRUE(cross(camera, Vector3<double>{1.0, 0.0, 0.0}, {own}).empty());
    EXPECT_TRUE(cross(camera, Vector3<double>{-1.0, 0.0, 0.0}, {own}).empty());
    // A ray that moves inwards first, and then turns back, crosses the camera's own shell again.
    EXPECT_EQ(cross(camera, unit(Vector3<double>{-0.2, 1.0, 0.0}), {own}).size(), 1U);
  }
}

TEST(ShellCrossings, OnTheAxisFollowTheCameraAsItComesThere) {
  // A camera on the spin axis must see the same as one slightly off it, without a rotation of
  // azimuth, because both are at φ = 0.
  const Vector3<double> n = unit(Vector3<double>{-1.0, 0.4, 0.2});
  const auto on = cross(make_camera_station(Spacetime{0.9}, 10.0, 0.0, 0.0, ObserverMotion::zamo), n, {6.0, 14.0});
  const auto beside = cross(make_camera_station(Spacetime{0.9}, 10.0, 1e-9, 0.0, ObserverMotion::zamo), n, {6.0, 14.0});
  ASSERT_EQ(on.size(), beside.size());
  ASSERT_FALSE(on.empty());
  for (std::size_t i = 0; i < on.size(); ++i) {
    EXPECT_LT(length(direction_of(on[i].position) - direction_of(beside[i].position)), 1e-7);
  }
}

TEST(ShellCrossings, HaveExactDerivatives) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 10.0, 1.0, 0.0, ObserverMotion::zamo);
  using D = Dual<double>;
  const auto at = [&](double y, double z) { return Vector3<double>{-std::sqrt(1.0 - y * y - z * z), y, z}; };
  const double y = 0.6;
  const double z = 0.5;
  const double x = std::sqrt(1.0 - y * y - z * z);
  const Vector3<D> n = {D(-x, y / x, z / x), D(y, 1.0, 0.0), D(z, 0.0, 1.0)};
  const auto exact = cross<D>(camera, n, {7.5, 12.0});
  constexpr double h = 1e-5;
  const auto after = cross(camera, at(y, z + h), {7.5, 12.0});
  const auto before = cross(camera, at(y, z - h), {7.5, 12.0});
  ASSERT_EQ(exact.size(), 3U);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const NearPosition<D>& position = exact[i].position;
    EXPECT_NEAR(position.m.x.along_y, (after[i].position.m.x - before[i].position.m.x) / (2.0 * h), 1e-6);
    EXPECT_NEAR(position.m.z.along_y, (after[i].position.m.z - before[i].position.m.z) / (2.0 * h), 1e-6);
    EXPECT_NEAR(position.drag.along_y, (after[i].position.drag - before[i].position.drag) / (2.0 * h), 1e-6);
    EXPECT_NEAR(position.u.along_y, 0.0, 1e-13);
  }
}

TEST(ShellCrossings, AreWhereThePicturesFloatSeesThem) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> spread(-0.6, 0.6);
  int compared = 0;
  for (const double spin : {0.0, 0.9, 0.999}) {
    const CameraStation camera = make_camera_station(Spacetime{spin}, 9.0, 1.2, 0.0, ObserverMotion::zamo);
    const auto in_float = converted_station<float>(camera);
    for (int i = 0; i < 200; ++i) {
      const Vector3<double> n = unit(Vector3<double>{-1.0, spread(random), spread(random)});
      const double shells[] = {30.0, 7.0, horizon_radius(Spacetime{spin}) * 1.01};
      const float u[] = {static_cast<float>(1.0 / shells[0]), static_cast<float>(1.0 / shells[1]),
                         static_cast<float>(1.0 / shells[2])};
      Collector<float> collector;
      const Vector3<float> view = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
      trace_shells<10, NearParts::azimuth>(in_float.spin, start_near_ray(in_float, view), {u, 3}, {1e-6F, 200}, true,
                                           collector);
      const auto exact = cross(camera, n, {shells[0], shells[1], shells[2]});
      if (exact.size() != collector.found.size()) {
        // Skips rays that nearly fall in, or nearly miss a shell: float and double may disagree
        // about them.
        continue;
      }
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const NearPosition<float>& at = collector.found[k].position;
        const NearPosition<double> wide = {at.u,        at.u_rate, {at.m.x, at.m.y, at.m.z}, at.drag, at.delay,
                                           at.distance, at.time};
        const double slow = std::abs(exact[k].position.u_rate / exact[k].position.u);
        if (exact[k].position.time < 0.6 && slow > 1.0) {
          EXPECT_LT(length(direction_of(wide) - direction_of(exact[k].position)), 5e-4) << spin << " " << i;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 600);
}

TEST(ShellEmitter, SeesWhatACameraInItsPlaceSees) {
  // Light is followed backwards from a ZAMO camera. By definition, its frequency is 1 at the
  // camera.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  for (const double spin : {0.0, 0.9, -1.0}) {
    for (const double r : {2.3, 9.0}) {
      const CameraStation camera = make_camera_station(Spacetime{spin}, r, 1.1, 0.0, ObserverMotion::zamo);
      const Vector3<double> n = unit(Vector3<double>{spread(random), spread(random), spread(random)});
      const NearRay<double> ray = start_near_ray(camera, n);
      EXPECT_NEAR(zamo_frequency(spin, r, std::sin(1.1), std::cos(1.1), ray.energy, ray.axial_angular_momentum), 1.0,
                  1e-13);
    }
  }
}

}  // namespace
}  // namespace ergodome::test
