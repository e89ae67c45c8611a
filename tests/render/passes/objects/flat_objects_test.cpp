#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/launch/work_counter.h"
#include "tests/render/passes/disk/compare_with_walk.h"
#include "tests/render/passes/objects/flat_ball.h"

// Tests of traced objects, as eyes of the stereo model `flat` see them.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): scenes of tests

std::string white_ball(const std::string& position, const std::string& size) {
  return "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nsegments = 96\nrings = 48\nposition = [" + position +
         "]\nsize = " + size + "\n";
}

const std::string spinning = "[[camera.key]]\nr = 24\ntheta_deg = 75\n[hole]\nspin = 0.9\n";

constexpr int pixels = sanitized ? 3 : 8;

constexpr const char* takes_long = "takes long under sanitizers, which see the same code in other scenes";

//! Returns a show with the given objects and camera, and a picture on a flat screen.
Show objects_show(const std::string& scene, const std::string& camera, double baseline, int fov_deg = 60,
                  int size_px = sanitized ? 48 : 56) {
  return flat_show(scene, camera, baseline, "projection = \"pinhole\"\nfov_deg = " + std::to_string(fov_deg) + "\n",
                   size_px);
}

void expect_what_lines_of_sight_meet(const Show& show) { compare_with_walk(show, LensChoice::direct, pixels); }

TEST(FlatObjects, BehindASpinningHoleAreWhatLinesOfSightMeetInFlatSpace) {
  for (const double baseline : sanitized ? std::vector<double>{4.0} : std::vector<double>{0.1, 4.0}) {
    SCOPED_TRACE(baseline);
    expect_what_lines_of_sight_meet(objects_show(white_ball("-7, 5, 3", "3"), spinning, baseline));
  }
}

TEST(FlatObjects, AreWhereTheClosedFormPutsThemBesideAHoleWithoutSpin) {
  if (sanitized) {
    GTEST_SKIP() << takes_long;
  }
  std::vector<BallBeforeHead> balls = balls_before_heads();
  const auto beside = std::ranges::find(balls, std::string("beside the hole"), &BallBeforeHead::name);
  ASSERT_NE(beside, balls.end());
  beside->traced = true;
  beside->view = "projection = \"pinhole\"\nfov_deg = 100\nsize_px = 300\n";
  expect_where_flat_space_puts(*beside);
}

TEST(FlatObjects, RightBehindTheHoleAreRingsThere) {
  // The ball is exactly behind the hole, as seen from the camera at θ = 75°.
  expect_what_lines_of_sight_meet(objects_show(white_ball("-11.6, 0, -3.1", "3"), spinning, 1.5));
}

TEST(FlatObjects, BeforeTheHoleAreWhatLinesOfSightMeetInFlatSpace) {
  if (sanitized) {
    GTEST_SKIP() << takes_long;
  }
  expect_what_lines_of_sight_meet(objects_show(white_ball("12, 2, 4", "1.5"), spinning, 3.0, 50));
}

TEST(FlatObjects, NextToTheHorizonAreWhatLinesOfSightMeetInFlatSpace) {
  expect_what_lines_of_sight_meet(objects_show(white_ball("1.5, 3, 1", "1.2"), spinning, 2.0, 25));
}

TEST(FlatObjects, OfAMovingHeadAreWhatItsOwnFlatSpaceHas) {
  const std::string moving =
      "observer = \"geodesic\"\n[[camera.key]]\nr = 12\ntheta_deg = 60\nroll_deg = 30\n[hole]\nspin = -0.7\n";
  expect_what_lines_of_sight_meet(objects_show(white_ball("-4, 5, 1", "3"), moving, 0.6, 90));
}

TEST(FlatObjects, OfEyesFartherApartThanTheyAreWideAreThatToo) {
  if (sanitized) {
    GTEST_SKIP() << takes_long;
  }
  const std::string far = "[[camera.key]]\nr = 1000\ntheta_deg = 60\n[hole]\nspin = 0.9\n";
  // The image of the ball is only a few pixels wide.
  compare_with_walk(objects_show(white_ball("3, 9, 2", "4"), far, 40.0, 5, 80), LensChoice::direct, pixels);
}

//! TOML text of an opaque shell whose light differs from that of objects.
const std::string grey_shell =
    "[[shells]]\nradius = 5\nfill_opacity = 1\nfill_color = [0.3, 0.3, 0.3]\nline_opacity = 0\n";

TEST(FlatObjects, ThatADiskCutsThroughAreBeforeItAndBehindIt) {
  // The ball is behind the hole and intersects the plane of the disk.
  const Show show = objects_show(white_ball("-7, 6, 0.5", "3") + plain_disk, spinning, 2.0);
  for (const LensChoice lens : {LensChoice::direct, LensChoice::live}) {
    const auto start = work_done();
    compare_with_walk(show, lens, sanitized ? 2 : 2 * pixels);
    EXPECT_EQ(work_between(start, work_done()).contains("look_up_flat_eyes"), lens == LensChoice::live);
  }
}

TEST(FlatObjects, ThatAShellCutsThroughAreBeforeItAndBehindIt) {
  expect_what_lines_of_sight_meet(objects_show(white_ball("3, 5, 2", "3") + grey_shell, spinning, 2.0, 40));
}

TEST(FlatObjects, BetweenADiskAndAShellAreInTheOrderOfTheirDistance) {
  if (sanitized) {
    GTEST_SKIP() << takes_long;
  }
  compare_with_walk(objects_show(white_ball("2, 6, 0.5", "3") + plain_disk + grey_shell, spinning, 2.0, 40),
                    LensChoice::direct, 2 * pixels);
}

//! The difference between the pictures of eyes of the model `flat` and the picture of the head.
struct Difference {
  double light = 0.0;    //!< light of the head's picture
  double mean = 0.0;     //!< mean difference, relative to `light`
  double maximum = 0.0;  //!< largest difference of a pixel
};

Difference difference_from_head(Show show, double baseline) {
  show.stereo.baseline = baseline;
  const auto eyes = eyes_of(show, LensChoice::direct);
  // The picture of the head is rendered with another stereo model, with both eyes at the head.
  show.stereo.model = StereoModel::physical;
  show.stereo.baseline = 0.0;
  const Picture head = eyes_of(show, LensChoice::direct)[0];
  Difference difference;
  for (std::size_t i = 0; i < head.rgba.size(); ++i) {
    const auto own = static_cast<double>(head.rgba[i]);
    difference.light += i % 4 < 3 ? own : 0.0;
    for (std::size_t eye = 0; eye < 2 && i % 4 < 3; ++eye) {
      const double off = std::abs(static_cast<double>(eyes[eye].rgba[i]) - own);
      difference.mean += 0.5 * off;
      difference.maximum = std::max(difference.maximum, off);
    }
  }
  difference.mean /= difference.light;
  return difference;
}

const std::string lamp_and_shift = "[light]\nposition = [6, 14, 9]\n[effects]\nredshift = true\n";

TEST(FlatObjects, AreTheHeadsWithoutABaseline) {
  const Difference difference = difference_from_head(objects_show(white_ball("-7, 5, 3", "3"), spinning, 1.0), 0.0);
  EXPECT_GT(difference.light, 10.0);
  EXPECT_EQ(difference.maximum, 0.0);
}

TEST(FlatObjects, AreLitAndShiftedAsTheHeadSeesThemWhereEyesAreClose) {
  const std::string ball = white_ball("-7, 5, 3", "3") + "light = \"lambert\"\n";
  const Difference difference = difference_from_head(objects_show(ball + lamp_and_shift, spinning, 1.0, 60, 120), 1e-6);
  EXPECT_GT(difference.light, 0.01);
  // The light of the lamp arrives on two paths and casts shadows. The samples of a pixel meet the
  // edges of the shadows at random.
  EXPECT_LT(difference.mean, 3e-3);
}

TEST(FlatObjects, AreSeenInEveryProjectionOverItsSeamsToo) {
  // In the cube layout, the ball is above the front of the camera, across the edge between two
  // faces.
  for (const char* const projection : {"cube", "dome", "equirect", "cylinder"}) {
    SCOPED_TRACE(projection);
    const Show show = flat_show(white_ball("15, 1, 14", "4"), spinning, 1.0,
                                "projection = \"" + std::string(projection) + "\"\n", sanitized ? 120 : 240);
    const Difference difference = difference_from_head(show, 1e-6);
    EXPECT_GT(difference.light, 100.0);
    EXPECT_LT(difference.mean, 1e-2);
    EXPECT_LT(difference.maximum, 0.7);
  }
}

TEST(FlatObjects, AreSeenOverSeamsThatPassThroughTiles) {
  // The width of the faces is odd. In a strip, pixels next to each other may belong to different
  // faces, which are not adjacent on the sky.
  const Show show = flat_show(white_ball("15, 1, 14", "9"), spinning, 1.0,
                              "projection = \"cube\"\ncube_layout = \"strip\"\n", sanitized ? 210 : 354);
  const Difference difference = difference_from_head(show, 1e-6);
  EXPECT_GT(difference.light, 100.0);
  EXPECT_LT(difference.mean, 1e-2);
  EXPECT_LT(difference.maximum, 0.7);
}

TEST(FlatObjects, ThatAreRetardedAreSeenWhereTheyWere) {
  const std::string ball =
      "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\norbit = { r = 9, phi_deg = 120, speed = 1 }\nsize = 2\n";
  const Show now = objects_show(ball + lamp_and_shift, spinning, 1.0, 60, 120);
  const Show then = objects_show(ball + "retarded = true\n" + lamp_and_shift, spinning, 1.0, 60, 120);
  const Difference difference = difference_from_head(then, 1e-6);
  EXPECT_GT(difference.light, 100.0);
  // A part of the light is in images that are thinner than a tenth of a pixel, which the samples of
  // pixels meet at random.
  EXPECT_LT(difference.mean, 2e-2);
  const Picture moved = eyes_of(now, LensChoice::direct)[0];
  const Picture seen = eyes_of(then, LensChoice::direct)[0];
  double apart = 0.0;
  for (std::size_t i = 0; i < seen.rgba.size(); ++i) {
    apart += static_cast<double>(i % 4 < 3 ? std::abs(moved.rgba[i] - seen.rgba[i]) : 0.0F);
  }
  EXPECT_GT(apart, 0.2 * difference.light);
}

}  // namespace
}  // namespace ergodome
