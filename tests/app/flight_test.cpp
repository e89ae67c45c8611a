#include "app/flight.h"

#include <gtest/gtest.h>

#include "app/player_keys.h"
#include "content/show_reader.h"
#include "kernels/metric/kerr.h"
#include "render/frame/show_renderer.h"

namespace ergodome {
namespace {

Show show_with(const std::string& observer) {
  return parse_show("[hole]\nspin = 0.9\n[camera]\nobserver = \"" + observer + "\"\n[[camera.key]]\nr = 12\n",
                    "f.toml");
}

TEST(Flight, NeverLeavesTheRegionWhereItsObserverExists) {
  for (const char* observer : {"zamo", "static", "geodesic", "retrograde", "rain"}) {
    const Show show = show_with(observer);
    Flight flight(show);
    for (int i = 0; i < 2000; ++i) {
      flight.orbit(0.1, i % 2 == 0 ? 0.3 : -0.29, 0.9);
      EXPECT_NO_THROW(eye_camera(show, flight.pose(), 0.0)) << observer << " r " << flight.pose().r;
    }
    EXPECT_LT(flight.pose().r, least_radius(show) + 1e-3) << observer;
  }
}

TEST(Flight, ComesBackFromTheHole) {
  Flight flight(show_with("zamo"));
  for (int i = 0; i < 500; ++i) {
    flight.orbit(0.0, 0.0, 0.5);
  }
  for (int i = 0; i < 500; ++i) {
    flight.orbit(0.0, 0.0, 1.5);
  }
  EXPECT_GT(flight.pose().r, 100.0);
}

TEST(Flight, LookingAroundKeepsTheOrientationAUnitQuaternion) {
  Flight flight(show_with("zamo"));
  for (int i = 0; i < 100'000; ++i) {
    flight.look(0.01, 0.003);
  }
  EXPECT_NEAR(glm::length(flight.pose().orientation), 1.0, 1e-12);
}

TEST(PlayerKeys, KeysThatSteerAndKeysThatActAreThoseOfTheMap) {
  EXPECT_EQ(action_of(' '), KeyAction::pause);
  EXPECT_EQ(action_of('A'), KeyAction::left);
  EXPECT_EQ(action_of('W'), KeyAction::in);
  EXPECT_EQ(action_of('F'), KeyAction::down);
  EXPECT_EQ(action_of('['), KeyAction::baseline_smaller);
  EXPECT_EQ(action_of('J'), KeyAction::none);
  EXPECT_NE(key_help().find("Space"), std::string::npos);
}

}  // namespace
}  // namespace ergodome
