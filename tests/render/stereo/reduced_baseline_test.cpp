#include "render/stereo/reduced_baseline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/spacetime/kerr/kerr.h"
#include "render/frame/show_renderer.h"
#include "render/stereo/eye_distance.h"
#include "tests/render/stereo_scene.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): shows of tests

Show show_of_far_eyes(const std::string& model, double baseline, double r) {
  return show_of_eyes(fmt::format("model = \"{}\"\nbaseline = {}\n", model, baseline),
                      "projection = \"dome\"\nfov_deg = 180\nsize_px = 64\n",
                      fmt::format("r = {}\ntheta_deg = 80\n", r));
}

CameraPose falling_pose(const Show& show, double r) {
  CameraPose pose = camera_pose(show, 0.0);
  pose.r = r;
  pose.velocity = Vector3<double>{0.0, 0.0, 0.0};
  pose.velocity_in_rain = true;
  return pose;
}

//! Returns the mean difference of two pictures, relative to the mean light of the first one.
double difference_of(const std::vector<FrameImage>& first, const std::vector<FrameImage>& second) {
  double different = 0.0;
  double light = 0.0;
  for (std::size_t eye = 0; eye < first.size(); ++eye) {
    const auto& a = first[eye].picture.rgba;
    const auto& b = second[eye].picture.rgba;
    for (std::size_t i = 0; i < a.size(); ++i) {
      different += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      light += static_cast<double>(a[i]);
    }
  }
  return different / light;
}

TEST(ReducedBaseline, StandAsAskedUpToTheGreatestDistanceAndNoFarther) {
  for (const char* const model : {"flat", "omni"}) {
    const Show show = show_of_far_eyes(model, 1.0, 3.0);
    const CameraPose pose = camera_pose(show, 0.0);
    const double maximum = max_baseline(show, pose);
    Show less = show;
    less.stereo.baseline = 0.999 * maximum;
    Show more = show;
    more.stereo.baseline = 1.001 * maximum;
    EXPECT_EQ(fitting_baseline(less, pose), less.stereo.baseline) << model;
    EXPECT_EQ(fitting_baseline(more, pose), maximum) << model;
  }
}

TEST(ReducedBaseline, OfTheModelFlatAreNoFartherApartThanTheHorizonOfAHoleWithoutSpinIsAway) {
  Show show = show_of_far_eyes("flat", 1.0, 6.0);
  show.spin = 0.0;
  // For radial light, dr/dλ = E with the affine parameter λ. If a static observer measures energy
  // 1, E = √(1 - 2/r).
  EXPECT_NEAR(max_baseline(show, camera_pose(show, 0.0)), 4.0 / std::sqrt(1.0 - 2.0 / 6.0), 1e-6);
}

TEST(ReducedBaseline, OfTheModelPhysicalHaveNoLimit) {
  const Show show = show_of_far_eyes("physical", 1e6, 2.0);
  EXPECT_EQ(fitting_baseline(show, camera_pose(show, 0.0)), 1e6);
}

TEST(ReducedBaseline, AreClosestTogetherWithoutALeapOnAFallThroughTheHorizon) {
  for (const double spin : {0.0, 0.6, 0.9, 1.0}) {
    Show show = show_of_far_eyes("omni", 1.0, 9.0);
    show.spin = spin;
    const double deepest = std::min(min_interior_radius(Spacetime{spin}), horizon_radius(Spacetime{spin}));
    double before = omni_room(Spacetime{spin}, falling_pose(show, 20.0));
    for (double r = 20.0; r > 1.01 * deepest + 0.01; r = deepest + 0.99 * (r - deepest)) {
      const double room = omni_room(Spacetime{spin}, falling_pose(show, r));
      ASSERT_GT(room, 0.0) << spin << " " << r;
      ASSERT_LE(room, before * (1.0 + 1e-9)) << spin << " " << r;
      ASSERT_GT(room, 0.9 * before) << spin << " " << r;
      before = room;
    }
  }
}

TEST(ReducedBaseline, OfTheModelOmniCanBeDrawnWhereThePlaceAloneIsTheLimit) {
  const Show show = show_of_far_eyes("omni", 1.0, 9.0);
  for (const double r : {0.9, 1.31, 1.5, 1.6, 4.0, 60.0}) {
    const CameraPose pose = falling_pose(show, r);
    EXPECT_EQ(max_baseline(show, pose), omni_room(spacetime_of(show), pose)) << r;
  }
}

TEST(ReducedBaseline, LeaveThePictureAsItIsAcrossTheLimit) {
  for (const char* const model : {"flat", "omni"}) {
    const Show probe = show_of_far_eyes(model, 1.0, 2.5);
    const double maximum = max_baseline(probe, camera_pose(probe, 0.0));
    ShowRenderer fits(show_of_far_eyes(model, 0.9999 * maximum, 2.5), Backend::cpu);
    ShowRenderer reduced(show_of_far_eyes(model, 30.0, 2.5), Backend::cpu);
    const auto first = fits.render(0.0, {});
    const auto second = reduced.render(0.0, {});
    EXPECT_FALSE(fits.reduced_baseline()) << model;
    ASSERT_TRUE(reduced.reduced_baseline()) << model;
    EXPECT_EQ(reduced.reduced_baseline()->baseline, maximum) << model;
    EXPECT_LT(difference_of(first, second), 1e-3) << model;
  }
}

TEST(ReducedBaseline, AreDrawnWhateverDistanceIsAskedFor) {
  for (const char* const model : {"flat", "omni"}) {
    ShowRenderer renderer(show_of_far_eyes(model, 1e6, 1.6), Backend::cpu);
    EXPECT_EQ(renderer.render(0.0, {}).size(), 2U) << model;
  }
}

TEST(ReducedBaseline, AreToldWithTheLineOfTheirDistanceAndTheTimeWhenThatBegins) {
  Show show = parse_show(
      "duration_s = 10\n[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nt_s = 0\nr = 10\n[[camera.key]]\nt_s = 10\nr = "
      "2\n"
      "[stereo]\nlayout = \"separate\"\nmodel = \"flat\"\nbaseline = 1.5\n",
      "near.toml");
  const auto path = baseline_reductions(show);
  ASSERT_TRUE(path);
  EXPECT_GE(fitting_baseline(show, camera_pose(show, path->first_s - 0.02)), 1.5);
  EXPECT_LT(fitting_baseline(show, camera_pose(show, path->first_s)), 1.5);
  EXPECT_EQ(path->smallest_s, 10.0);
  EXPECT_EQ(path->smallest.baseline, max_baseline(show, camera_pose(show, 10.0)));
  EXPECT_NE(note_of(show, *path).find("near.toml:14"), std::string::npos) << note_of(show, *path);
}

TEST(ReducedBaseline, AreNotToldOfWhereAllFit) {
  EXPECT_FALSE(baseline_reductions(show_of_far_eyes("omni", 0.1, 9.0)));
}

}  // namespace
}  // namespace ergodome
