#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "content/show/unused_keys.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

//! Returns a show with three camera keys around a hole of spin 0.9. The arguments are additional
//! lines of each key and of the [camera] table.
Show keyed_show(const std::string& first, const std::string& second, const std::string& third,
                const std::string& camera = "") {
  return parse_show("duration_s = 10\n[hole]\nspin = 0.9\n[camera]\n" + camera + "[[camera.key]]\nr = 20\n" + first +
                        "[[camera.key]]\nt_s = 4\nr = 9\n" + second + "[[camera.key]]\nt_s = 10\nr = 12\n" + third,
                    "k.toml");
}

const std::string fast_ahead = "velocity = { beta = 0.999, toward = [0, 0, 1] }\n";
const std::string fast_aside = "velocity = { beta = 0.999, toward = [1, 0, 0] }\n";

TEST(KeyVelocity, IsThatOfWhoLooksAtTheKey) {
  const Show show = keyed_show(fast_ahead, "velocity = \"rain\"\n", fast_aside);
  EXPECT_NEAR(camera_pose(show, 0.0).velocity->z, 0.999, 1e-15);
  EXPECT_NEAR(camera_pose(show, 4.0).velocity->x,
              observer_velocity(ObserverMotion::rain, Spacetime{0.9}, 9.0, std::acos(0.0), {}).x, 1e-12);
  EXPECT_NEAR(camera_pose(show, 10.0).velocity->x, 0.999, 1e-15);
}

TEST(KeyVelocity, IsBelowThatOfLightBetweenKeysThatDisagree) {
  const Show show = keyed_show(fast_ahead, fast_aside, fast_ahead);
  for (int i = 0; i <= 1000; ++i) {
    const Vector3<double> v = *camera_pose(show, 0.01 * i).velocity;
    EXPECT_LT(dot(v, v), 1.0) << i;
  }
}

TEST(KeyVelocity, ChangesWithoutALeapInItsRate) {
  const Show show = keyed_show("velocity = { beta = 0.5, toward = [0, 0, 1] }\n",
                               "velocity = { beta = 0.6, toward = [0, 1, 1] }\n", "velocity = \"rain\"\n");
  const auto rate = [&](double time_s) {
    constexpr double step_s = 1e-4;
    const Vector3<double> change = *camera_pose(show, time_s + step_s).velocity - *camera_pose(show, time_s).velocity;
    return (1.0 / step_s) * change;
  };
  const Vector3<double> leap = rate(4.0 + 1e-6) - rate(4.0 - 1e-4 - 1e-6);
  EXPECT_LT(std::sqrt(dot(leap, leap)), 1e-3);
}

TEST(KeyVelocity, IsWrittenAsItIsRead) {
  const Show show = keyed_show(fast_ahead, "velocity = \"rain\"\n", "velocity = \"zamo\"\n");
  const Show again = parse_show(to_toml(show), "again.toml");
  for (const double time_s : {0.0, 2.0, 4.0, 7.0, 10.0}) {
    const Vector3<double> off = *camera_pose(again, time_s).velocity - *camera_pose(show, time_s).velocity;
    EXPECT_LT(std::sqrt(dot(off, off)), 1e-12);
  }
}

TEST(KeyVelocity, LeavesTheShowsObserverToFreeFlight) {
  const Show show = keyed_show(fast_ahead, fast_ahead, fast_ahead, "observer = \"static\"\n");
  EXPECT_THAT(unused_keys(show), testing::IsEmpty());
  EXPECT_EQ(parse_show(to_toml(show), "again.toml").camera.motion, ObserverMotion::fixed);
}

TEST(KeyVelocity, IsForAllKeysOrNone) {
  EXPECT_THAT(test::error_of([] { keyed_show(fast_ahead, "", fast_ahead); }),
              HasSubstr("k.toml:8: camera.key[1].velocity is missing"));
  EXPECT_THAT(test::error_of([] { keyed_show("", "", fast_ahead); }),
              HasSubstr("k.toml:13: camera.key[2].velocity is missing from the keys before this one"));
}

TEST(KeyVelocity, IsRefusedWhereItIsNone) {
  EXPECT_THAT(
      test::error_of([] { keyed_show("velocity = { beta = 1, toward = [0, 0, 1] }\n", fast_ahead, fast_ahead); }),
      HasSubstr("camera.key[0].velocity.beta"));
  EXPECT_THAT(test::error_of([] {
                parse_show("[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 1.5\nvelocity = \"static\"\n", "k.toml");
              }),
              HasSubstr("k.toml:6: camera.key[0].velocity would exceed the speed of light at r = 1.5 M"));
  EXPECT_THAT(
      test::error_of([] { keyed_show(fast_ahead, fast_ahead, fast_ahead, "[camera.fall]\nclock = 1\nuntil_s = 5\n"); }),
      HasSubstr("camera.key[0].velocity cannot be combined with a fall that ends"));
}

}  // namespace
}  // namespace ergodome
