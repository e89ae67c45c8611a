#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "content/camera/free_fall.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/spacetime/kerr/observer.h"
#include "render/passes/disk/disk_pass.h"
#include "tests/render/disk_scenes.h"

// Tests of clouds in a disk.
namespace ergodome {
namespace {

using test::show_with;
using test::uniform_disk;

TEST(DiskPattern, GoesOnSmoothlyFromPeriodToPeriodHoweverLateItIs) {
  const DiskSettings settings = uniform_disk(6.0, 18.0);
  const double period = static_cast<double>(pattern_time(settings, Spacetime{0.3}, 0.0).period);
  for (const double start : {0.0, 2e10}) {
    const std::uint32_t cycle = pattern_time(settings, Spacetime{0.3}, start).cycle;
    double earlier = start;
    double later = start + 1.01 * period;
    for (int round = 0; round < 40; ++round) {
      const double middle = 0.5 * (earlier + later);
      (pattern_time(settings, Spacetime{0.3}, middle).cycle == cycle ? earlier : later) = middle;
    }
    const PatternTime before = pattern_time(settings, Spacetime{0.3}, earlier);
    const PatternTime after = pattern_time(settings, Spacetime{0.3}, later);
    EXPECT_EQ(after.cycle, cycle + 1U) << start;
    const float a = disk_pattern(before, 10.0F, 1.0F, 0.03F, 25.0F, 0.0F);
    const float b = disk_pattern(after, 10.0F, 1.0F, 0.03F, 25.0F, 0.0F);
    EXPECT_NEAR(a, b, 0.01F) << start;
  }
}

TEST(DiskPattern, FollowsTheFlow) {
  // The flow moves the pattern, so light with the delay t shows a point at φ where it was earlier,
  // at φ - Ω t.
  const PatternTime now = pattern_time(uniform_disk(6.0, 18.0), Spacetime{0.0}, 60.0);
  PatternTime later = now;
  later.age += 5.0F;
  const float rotation = 0.02F;
  EXPECT_NEAR(disk_pattern(now, 9.0F, 1.0F, rotation, 10.0F, 0.0F),
              disk_pattern(later, 9.0F, 1.0F, rotation, 15.0F, 0.0F), 1e-4F);
}

//! Lets the camera of a show fall in the rain frame along the spin axis, from r = 20 to `least_r`,
//! at 1 M of proper time per second.
void let_rain(Show& show, double least_r) {
  constexpr double from_r = 20.0;
  FallSettings settings;
  settings.clock = 1.0;
  settings.ease_s = 0.0;
  settings.least_r = least_r;
  const Vector3<double> velocity = observer_velocity(ObserverMotion::rain, spacetime_of(show), from_r, 0.0, {});
  show.camera.orbit = std::make_shared<const FreeFall>(spacetime_of(show), FallStart{from_r, 0.0, 0.0, velocity},
                                                       settings, nullptr, 80.0);
}

//! Light of the disk that a camera on the spin axis sees in one direction: the first crossing of
//! the disk.
struct LightOfDisk {
  double r;
  //! Travel time of the light [M].
  double delay;
  //! Frequency that the camera sees, relative to the frequency in the frame of matter on circular
  //! orbits.
  double frequency;
};

LightOfDisk light_of_disk(const CameraStation& camera, double from_axis) {
  EquatorialCrossing<double> found[crossing_orders];
  const NearRay<double> ray = start_near_ray(camera, Vector3<double>{std::cos(from_axis), std::sin(from_axis), 0.0});
  trace_crossings<20, true>(camera.spin, ray, {1e-7, 1e-14, 4000}, true, found);
  const DiskLight<double> light = {1.0 / found[0].u, ray.energy, ray.axial_angular_momentum, ray.shear_constant, false};
  return {light.r, found[0].delay, 1.0 / circular_frequency(camera.spin, light)};
}

//! Finds the light that comes from radius r of the disk. Bisects the angle from the spin axis,
//! between 0 and π, at which the camera sees it.
LightOfDisk light_from(const CameraStation& camera, double r) {
  double outer = 0.0;
  double inner = pi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (outer + inner);
    const double there = light_of_disk(camera, middle).r;
    (there > r ? outer : inner) = middle;
  }
  return light_of_disk(camera, 0.5 * (outer + inner));
}

TEST(DiskPattern, RunsFastOrSlowByTheShiftOfItsLightForWhoFallsIn) {
  // The frequency ratio g is the rate at which the disk's proper time passes as the camera sees it,
  // per unit of the camera's own proper time.
  constexpr double outward_r = 9.0;
  constexpr double between_s = 0.02;
  for (const double spin : {0.0, 0.7}) {
    DiskSettings disk = uniform_disk(6.0, 18.0);
    disk.pattern = DiskPattern::procedural;
    Show show = show_with(spin, disk);
    let_rain(show, 0.8);
    const DiskPass pass(show, Backend::cpu);
    const double horizon_s = *show.camera.orbit->horizon_s();
    for (const double time_s : {5.0, 20.0, horizon_s - 0.5, horizon_s + 0.1}) {
      const auto emitted = [&](double at_s, double* frequency) {
        const FallPosition position = show.camera.orbit->at(at_s);
        const CameraStation camera = make_camera_station(Spacetime{spin}, position.r, position.theta, 0.0,
                                                         ObserverMotion::rain_boost, position.velocity);
        const LightOfDisk light = light_from(camera, outward_r);
        *frequency = light.frequency;
        const PatternTime pattern = pass.look_at(at_s, outer_lag(Spacetime{spin}, position.r)).pattern;
        return static_cast<double>(pattern.cycle) * static_cast<double>(pattern.period) +
               static_cast<double>(pattern.age) - light.delay;
      };
      double first = 0.0;
      double last = 0.0;
      const double passed = emitted(time_s + between_s, &last) - emitted(time_s, &first);
      const double swirl = outward_r * std::sqrt(outward_r);
      const double own = std::sqrt(1.0 - 3.0 / outward_r + 2.0 * spin / swirl) / (1.0 + spin / swirl);
      EXPECT_NEAR(passed * own / between_s, 0.5 * (first + last), 2e-3) << spin << ' ' << time_s;
    }
  }
}

TEST(DiskPattern, IsNothingWhereTimeHasNoEnd) {
  const PatternTime now = pattern_time(uniform_disk(6.0, 18.0), Spacetime{0.0}, 60.0);
  for (const float endless : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(disk_pattern(now, 9.0F, 1.0F, 0.02F, endless, 0.0F), 0.0F);
    EXPECT_EQ(disk_pattern(now, 9.0F, endless, 0.02F, 10.0F, 0.0F), 0.0F);
  }
}

TEST(DiskPattern, ClosesAroundTheDisk) {
  const PatternTime now = pattern_time(uniform_disk(6.0, 18.0), Spacetime{0.0}, 60.0);
  EXPECT_NEAR(disk_pattern(now, 9.0F, -3.14159265F, 0.02F, 10.0F, 0.0F),
              disk_pattern(now, 9.0F, 3.14159265F, 0.02F, 10.0F, 0.0F), 1e-3F);
}

}  // namespace
}  // namespace ergodome
