#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "render/lens/grid/edge_table.h"

namespace ergodome {
namespace {

//! Returns the error [rad] of the shadow's edge for a ZAMO observer, if it is converted from the
//! table for an observer of the rain frame.
double miss_of(double spin, double r, double theta = 0.5 * pi) {
  const auto observer = ObserverMotion::zamo;
  const EdgeTable rain(Backend::cpu, make_camera_station(Spacetime{spin}, r, theta, 0.0, ObserverMotion::rain),
                       edge_points);
  return edge_miss(rain.view(), make_camera_station(Spacetime{spin}, r, theta, 0.0, observer),
                   aberration_to_rain(Spacetime{spin}, r, theta, observer, {}));
}

TEST(EdgeMiss, IsNothingForWhoMovesSlowlyPastTheRain) {
  EXPECT_EQ(miss_of(1.0, 6.0), 0.0);
  EXPECT_EQ(miss_of(0.0, 3.0), 0.0);
}

TEST(EdgeMiss, IsSmallBesideHorizonsThatAreNotExtremal) {
  for (const double spin : {0.0, 0.5, 0.9, -0.9}) {
    EXPECT_LT(miss_of(spin, horizon_radius(Spacetime{spin}) + 1e-4), 1e-6) << spin;
  }
}

TEST(EdgeMiss, IsTinyUpToTheSpinForWhichNobodyAsks) {
  for (const double above : {1e-5, 1e-3, 1e-2}) {
    EXPECT_LT(miss_of(0.999, horizon_radius(Spacetime{0.999}) + above), 5e-5) << above;
  }
}

TEST(EdgeMiss, IsLargeBesideAnExtremalHorizonWhereTheRainsTableHasTheEdgeBetweenTwoPoints) {
  for (const double r : {1.01, 1.001, 1.0001}) {
    EXPECT_GT(miss_of(1.0, r), 0.02) << r;
    EXPECT_GT(miss_of(-1.0, r, 1.2), 0.02) << r;
  }
}

}  // namespace
}  // namespace ergodome
