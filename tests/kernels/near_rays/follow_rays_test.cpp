#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/near_rays/follow_to_radius.h"
#include "kernels/shells/shell_crossings.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome::test {
namespace {

//! A visitor that keeps the last shell crossing of a ray.
struct LastSeen {
  std::vector<WatchedShell> shells;
  int shell = -1;
  bool inwards = false;
  bool covered = false;

  void cross(int which, bool lanes, const NearPosition<double>& position) {
    if (lanes && !covered) {
      shell = which;
      inwards = position.u_rate > 0.0;
      covered = shells[static_cast<std::size_t>(which)].opaque;
    }
  }
  static void turn(bool, const NearPosition<double>&) {}
  [[nodiscard]] static bool done() { return false; }
};

const std::vector<WatchedShell>& watched() {
  static const std::vector<WatchedShell> shells = {
      {1.0F / 30.0F, false}, {1.0F / 12.0F, false}, {1.0F / 6.0F, true}, {1.0F / 3.2F, false}, {1.0F / 2.2F, true}};
  return shells;
}

Vector3<double> any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vector3<double> n = {normal(random), normal(random), normal(random)};
  return (1.0 / length(n)) * n;
}

TEST(FollowedRays, EndAtTheLastShellThatATracedRaySees) {
  std::mt19937 random(7);
  int met = 0;
  for (const double spin : {0.0, 0.9, -0.999}) {
    for (const double r : {40.0, 20.0, 8.0, 4.0, 2.9, 2.3, 1.2}) {
      const bool within = r < horizon_radius(Spacetime{spin});
      const CameraStation camera =
          make_camera_station(Spacetime{spin}, r, 1.1, 0.0, within ? ObserverMotion::rain : ObserverMotion::zamo);
      for (int i = 0; i < 300; ++i) {
        const Vector3<double> n = any_direction(random);
        const RayStart<double> start = start_ray(camera, n);
        if (!(start.energy > 0.0)) {
          continue;
        }
        LastSeen seen{watched()};
        std::vector<double> u;
        for (const WatchedShell& shell : watched()) {
          u.push_back(static_cast<double>(shell.u));
        }
        ASSERT_TRUE((trace_shells<20, NearParts::azimuth>(
            spin, start_near_ray(camera, n), {u.data(), static_cast<int>(u.size())}, {1e-13, 10'000}, true, seen)));
        const WayEnd<double> end =
            way_through_shells(spin, start, watched().data(), static_cast<int>(watched().size()));
        ASSERT_EQ(end.meets, seen.shell >= 0) << spin << " " << r << " " << i;
        if (end.meets) {
          ++met;
          EXPECT_EQ(end.u, u[static_cast<std::size_t>(seen.shell)]) << spin << " " << r << " " << i;
          EXPECT_EQ(end.side > 0.0, seen.inwards) << spin << " " << r << " " << i;
        }
      }
    }
  }
  EXPECT_GT(met, 2000);
}

// If 2 r_+ E < a L, the light that reaches a camera inside the horizon comes from another universe.
// Traced backwards, it leaves the horizon but soon turns back.
TEST(FollowedRays, MeetNoShellByLightThatHasNotBeenOutside) {
  constexpr double spin = 0.9;
  const CameraStation camera =
      make_camera_station(Spacetime{spin}, 1.2, 1.3, 0.0, ObserverMotion::rain_boost, {0.9, 0.0, 0.0});
  const WatchedShell shell = {static_cast<float>(1.0 / (camera.horizon_r + 0.01)), true};
  std::mt19937 random(9);
  int dark = 0;
  for (int i = 0; i < 4000; ++i) {
    const RayStart<double> start = start_ray(camera, any_direction(random));
    if (start.energy > 0.0 && 2.0 * camera.horizon_r < spin * start.axial_angular_momentum) {
      ++dark;
      EXPECT_FALSE(way_through_shells(spin, start, &shell, 1).meets) << i;
    }
  }
  EXPECT_GT(dark, 50);
}

TEST(FollowedRays, ComeOutOfTheHorizonInFewSteps) {
  const CameraStation camera = make_camera_station(Spacetime{0.6}, 1.2, 1.3, 0.0, ObserverMotion::rain);
  const WatchedShell shell = {1.0F / 12.0F, true};
  std::mt19937 random(8);
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const RayStart<double> start = start_ray(camera, any_direction(random));
    const WayEnd<double> end = way_through_shells(0.6, start, &shell, 1);
    if (end.meets && darkness(0.6, camera.horizon_r, start) < -0.1) {
      ++met;
      const IntegrationSettings settings = {1e-6, 1000, true};
      const FollowedRay<double> by_series = follow_taylor<10>(0.6, start, end, true, settings);
      EXPECT_TRUE(by_series.arrived && by_series.steps < 20.0) << by_series.steps;
      const FollowedRay<double> by_steps = follow_runge_kutta<RungeKutta34>(0.6, start, end, true, settings);
      EXPECT_TRUE(by_steps.arrived && by_steps.steps < 200.0) << by_steps.steps;
    }
  }
  EXPECT_GT(met, 50);
}

//! The number of steps and the error of an integrator, for rays from outside to a shell just above
//! the horizon.
struct Followed {
  double steps, error;
  bool arrived;
};

template <class Follow>
Followed follow(const Vector3<double>& n, double tolerance, const Follow& by) {
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 12.0, 0.5 * pi, 0.0, ObserverMotion::fixed);
  const WatchedShell shell = {1.0F / 2.02F, true};
  const RayStart<double> start = start_ray(camera, n);
  const WayEnd<double> end = way_through_shells(0.0, start, &shell, 1);
  EXPECT_TRUE(end.meets);
  const FollowedRay<double> ray = by(start, end, IntegrationSettings{tolerance, 100'000, true});
  return {ray.steps, ray.error, ray.arrived};
}

constexpr auto by_baseline = [](const auto& start, const auto& end, const IntegrationSettings& settings) {
  return follow_baseline(0.0, start, end, true, settings);
};
constexpr auto by_taylor = [](const auto& start, const auto& end, const IntegrationSettings& settings) {
  return follow_taylor<10>(0.0, start, end, true, settings);
};
constexpr auto by_pair = [](const auto& start, const auto& end, const IntegrationSettings& settings) {
  return follow_runge_kutta<RungeKutta34>(0.0, start, end, true, settings);
};

Vector3<double> beside_the_middle(double up, double right) {
  return {-std::sqrt(1.0 - up * up - right * right), -up, right};
}

TEST(FollowedRays, TakeMoreStepsWhereMoreIsAsked) {
  const Vector3<double> n = beside_the_middle(0.1, 0.15);
  for (const auto& steps_at : std::vector<std::function<Followed(double)>>{
           [&](double tolerance) { return follow(n, tolerance, by_pair); },
           [&](double tolerance) { return follow(n, tolerance, by_baseline); }}) {
    const Followed rough = steps_at(1e-4);
    const Followed fine = steps_at(1e-8);
    EXPECT_TRUE(rough.arrived && fine.arrived);
    EXPECT_GT(fine.steps, 3.0 * rough.steps);
    EXPECT_LT(fine.error, 0.1 * rough.error);
  }
}

TEST(FollowedRays, AreSlowNextToThePolesInPolarAnglesAlone) {
  // The ray starts straight upwards from the middle of the hole. Its plane contains the spin axis,
  // which it passes on its way to the far side of the shell.
  const Vector3<double> over_the_pole = beside_the_middle(0.36, 1e-4);
  const Vector3<double> beside = beside_the_middle(0.1, 0.34);
  const double polar = follow(over_the_pole, 1e-5, by_baseline).steps / follow(beside, 1e-5, by_baseline).steps;
  const double ours = follow(over_the_pole, 1e-5, by_taylor).steps / follow(beside, 1e-5, by_taylor).steps;
  EXPECT_GT(polar, 2.5);
  EXPECT_LT(ours, 1.5);
  EXPECT_TRUE(follow(over_the_pole, 1e-5, by_taylor).arrived);
}

}  // namespace
}  // namespace ergodome::test
