#include "content/camera/hole_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "kernels/disk/disk_emitter.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {
namespace {

//! Returns the coordinate time [M] of an observer of the rain frame around a hole without spin, up
//! to a constant. It is regular at the horizon: 2 r_+ W was subtracted, where W is the logarithm
//! that diverges there.
double time_of_rain(double r) {
  return -std::sqrt(2.0) / 3.0 * std::pow(r, 1.5) - 2.0 * std::sqrt(2.0 * r) + 4.0 * std::log1p(std::sqrt(2.0 / r));
}

TEST(HoleClock, RunsThroughTheHorizonAsTheClosedFormOfRainSays) {
  FallSettings settings;
  settings.time_s = 3.0;
  settings.clock = 2.0;
  settings.ease_s = 0.0;
  settings.least_r = 0.1;
  const FallStart start = {20.0, 1.1, 0.4, observer_velocity(ObserverMotion::rain, Spacetime{0.0}, 20.0, 1.1, {})};
  const auto orbit = std::make_shared<const FreeFall>(Spacetime{0.0}, start, settings, nullptr, 60.0);
  const HoleClock clock(Spacetime{0.0}, orbit, 7.0);
  for (const double after_s : {0.0, 5.0, 20.0, *orbit->horizon_s() - 3.0, *orbit->horizon_s() - 2.7}) {
    const double r = orbit->at(3.0 + after_s).r;
    EXPECT_NEAR(clock.time(3.0 + after_s), 21.0 + time_of_rain(r) - time_of_rain(20.0), 1e-9) << r;
  }
}

TEST(HoleClock, HasItsPaceWithoutAFall) {
  EXPECT_EQ(HoleClock(Spacetime{0.3}, nullptr, 20.0).time(7.3), 7.3 * 20.0);
  EXPECT_EQ(HoleClock(Spacetime{0.3}, nullptr, -2.0).time(-1.1), -1.1 * -2.0);
}

//! A fall on a circular orbit, where coordinate time is proportional to the camera's proper time.
class HoleClockOnACircle : public testing::Test {
 protected:
  HoleClockOnACircle() {
    settings_.time_s = 4.0;
    settings_.clock = 9.0;
    settings_.ease_s = 2.0;
    settings_.until_s = 20.0;
    const FallStart start = {r, 1.57079632679489662, 0.0,
                             observer_velocity(ObserverMotion::geodesic, Spacetime{spin}, r, 1.57079632679489662, {})};
    orbit_ = std::make_shared<const FreeFall>(Spacetime{spin}, start, settings_, nullptr, 40.0);
  }

  [[nodiscard]] double rate(const HoleClock& clock, double time_s) const {
    constexpr double h_s = 1e-5;
    return (clock.time(time_s + h_s) - clock.time(time_s - h_s)) / (2.0 * h_s);
  }

  static constexpr double spin = 0.6;
  static constexpr double r = 8.0;
  FallSettings settings_;
  std::shared_ptr<const FreeFall> orbit_;
  double dilation_ = circular_frequency(spin, DiskLight<double>{r, 1.0, 0.0, 0.0, false});
};

TEST_F(HoleClockOnACircle, RunsByTheOrbitInTheFallAndByItsPaceBesideIt) {
  const HoleClock clock(Spacetime{spin}, orbit_, 3.0);
  EXPECT_NEAR(rate(clock, 2.0), 3.0, 1e-6);
  EXPECT_NEAR(rate(clock, 12.0), 9.0 * dilation_, 1e-6);
  EXPECT_NEAR(rate(clock, 30.0), 3.0, 1e-6);
  // During each easing, the clock runs for half of the time at its own pace and for half at that of
  // the orbit.
  EXPECT_NEAR(clock.time(30.0), 3.0 * (4.0 + 1.0 + 1.0 + 10.0) + dilation_ * 9.0 * 14.0, 1e-8);
}

TEST_F(HoleClockOnACircle, BeginsAndEndsAtOnceWhereNothingIsEased) {
  settings_.ease_s = 0.0;
  const FallStart start = orbit_->start();
  const HoleClock clock(Spacetime{spin},
                        std::make_shared<const FreeFall>(Spacetime{spin}, start, settings_, nullptr, 40.0), 3.0);
  EXPECT_NEAR(clock.time(4.0), 3.0 * 4.0, 1e-9);
  EXPECT_NEAR(clock.time(20.0), 3.0 * 4.0 + dilation_ * 9.0 * 16.0, 1e-8);
  EXPECT_NEAR(clock.time(30.0), 3.0 * (4.0 + 10.0) + dilation_ * 9.0 * 16.0, 1e-8);
}

TEST_F(HoleClockOnACircle, GoesOverFromOneRateToTheOtherWithoutALeap) {
  // If the pace of the clock is the same as that of the orbit, the transition changes nothing.
  const HoleClock even(Spacetime{spin}, orbit_, 9.0 * dilation_);
  const HoleClock clock(Spacetime{spin}, orbit_, 3.0);
  for (double time_s = 3.0; time_s < 22.0; time_s += 0.25) {
    EXPECT_NEAR(rate(even, time_s), 9.0 * dilation_, 1e-5) << time_s;
    EXPECT_LT(std::abs(rate(clock, time_s + 0.01) - rate(clock, time_s)), 0.1) << time_s;
  }
}

}  // namespace
}  // namespace ergodome
