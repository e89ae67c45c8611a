#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/app/navigation/test_flights.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

//! Returns the view relative to nonrotating directions. In a fall through the horizon, these are
//! defined by the azimuth of ingoing Kerr coordinates.
glm::dquat steady_view(const Navigator& navigator) {
  const CameraPose pose = navigator.pose();
  return (pose.velocity_in_rain ? ingoing_placement(pose, navigator.space().spacetime()) : placement_of(pose)).view;
}

//! The fastest rotation of the view and its largest change, and the same of the ship's velocity,
//! while one control after another is held.
struct Worst {
  double turn = 0.0;
  double turn_change = 0.0;
  double speed = 0.0;
  double speed_change = 0.0;
};

Worst worst_of(Navigator& navigator, const CameraPose& path, int frames,
               const std::function<SteeringInput(int)>& input) {
  constexpr double step_s = 1.0 / 240.0;  // as long as the navigator's steps: resolves every change
  Worst worst;
  glm::dquat view = steady_view(navigator);
  bool falls = navigator.pose().velocity_in_rain;
  glm::dvec3 turn = navigator.turn_rate();
  glm::dvec3 velocity = navigator.fly_velocity();
  for (int i = 0; i < frames; ++i) {
    navigator.advance(step_s, input(i), path);
    const glm::dquat now = steady_view(navigator);
    // When a fall through the horizon begins or ends, rotations and velocities are measured in
    // different coordinates; the two frames are not compared.
    const bool counted_anew = falls != navigator.pose().velocity_in_rain;
    falls = navigator.pose().velocity_in_rain;
    if (counted_anew) {
      view = now;
      turn = navigator.turn_rate();
      velocity = navigator.fly_velocity();
      continue;
    }
    const glm::dvec3 rate = turn_of(now * glm::conjugate(view)) / step_s;
    worst.turn = std::max(worst.turn, glm::length(rate));
    worst.turn_change = std::max(worst.turn_change, glm::length(rate - turn) / step_s);
    worst.speed = std::max(worst.speed, glm::length(navigator.fly_velocity()));
    worst.speed_change = std::max(worst.speed_change, glm::length(navigator.fly_velocity() - velocity) / step_s);
    view = now;
    turn = rate;
    velocity = navigator.fly_velocity();
  }
  return worst;
}

void expect_comfort(const Worst& worst, const FlightSettings& settings) {
  EXPECT_LE(worst.turn, pi / 180.0 * settings.comfort.turn_deg_s * (1.0 + 1e-6));
  EXPECT_LE(worst.turn_change, pi / 180.0 * settings.comfort.turn_accel_deg_s2 * (1.0 + 1e-6));
  EXPECT_LE(worst.speed, settings.max_speed * (1.0 + 1e-9));
  EXPECT_LE(worst.speed_change, settings.comfort.accel * (1.0 + 1e-9));
}

TEST(Comfort, HoldsAgainstFullReversalsInEveryAxisAtTheWorstPeriods) {
  for (const char* mode : {"orbit", "fly"}) {
    for (const int period : {1, 7, 40, 160, 500}) {
      const Show show = show_at(0.9, 8.0, 60.0, std::string("mode = \"") + mode + "\"\n");
      Flier flier(show);
      const auto input = [&](int i) {
        const double s = (i / period) % 2 == 0 ? 1.0 : -1.0;
        return holding({s, s, -s, s, -s, s, 0.0, 1.0});
      };
      expect_comfort(worst_of(flier.navigator, flier.path, 3000, input), show.flight);
    }
  }
}

TEST(Comfort, HoldsAgainstAnythingAVisitorDoesWithTightLimitsToo) {
  for (const char* limits : {"comfort = { turn_deg_s = 10, turn_accel_deg_s2 = 5, accel = 0.2 }\n",
                             "comfort = { turn_deg_s = 200, turn_accel_deg_s2 = 2000, accel = 20 }\n", ""}) {
    const Show show = show_at(0.9, 8.0, 20.0, limits);
    Flier flier(show);
    std::mt19937 random(3);
    Steering held;
    const auto input = [&](int i) {
      if (i % 37 == 0) {
        held = wild(random);
      }
      if (i % 400 == 399) {
        flier.navigator.next_mode();
      }
      return SteeringInput{held, i % 90 == 0 ? wild(random) : Steering{}};
    };
    expect_comfort(worst_of(flier.navigator, flier.path, test::sanitized ? 4000 : 40'000, input), show.flight);
  }
}

TEST(Comfort, UsesWhatIsAllowed) {
  const Show show = show_at(0.9, 8.0, 60.0, "mode = \"fly\"\n");
  Flier flier(show);
  const Worst worst = worst_of(flier.navigator, flier.path, 1500, [](int) {
    return holding({0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  });
  EXPECT_GT(worst.turn, 0.5 * pi / 180.0 * show.flight.comfort.turn_deg_s);
  EXPECT_GT(worst.speed, 0.99 * show.flight.max_speed);
}

}  // namespace
}  // namespace ergodome
