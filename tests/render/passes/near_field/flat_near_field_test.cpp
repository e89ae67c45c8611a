#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/stereo/eye_disparity.h"
#include "tests/render/passes/disk/compare_with_walk.h"
#include "tests/support/sanitized.h"

// Tests of disks, shells and objects near the hole, as eyes of the stereo model `flat` see them.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): scenes of tests

const std::string above_the_plane = "[[camera.key]]\nr = 24\ntheta_deg = 75\nphi_deg = 20\n[hole]\nspin = 0.9\n";

TEST(FlatNearField, OfADiskIsWhatLinesOfSightMeetInFlatSpace) {
  const int pixels = sanitized ? 8 : 40;
  for (const double baseline : sanitized ? std::vector{2.0} : std::vector{0.5, 2.0}) {
    SCOPED_TRACE(baseline);
    compare_with_walk(flat_show(plain_disk, above_the_plane, baseline), LensChoice::direct, pixels);
  }
}

TEST(FlatNearField, OfADiskInAGridIsWhatLinesOfSightMeetInFlatSpace) {
  compare_with_walk(flat_show(plain_disk, above_the_plane, 1.0), LensChoice::live, sanitized ? 8 : 50);
}

TEST(FlatNearField, OfAMovingHeadIsWhatItsOwnFlatSpaceHas) {
  const std::string moving =
      "observer = \"geodesic\"\n[[camera.key]]\nr = 12\ntheta_deg = 60\nphi_deg = 20\nroll_deg = 30\n[hole]\nspin = "
      "-0.7\n";
  for (const LensChoice lens : {LensChoice::direct, LensChoice::live}) {
    compare_with_walk(flat_show(plain_disk, moving, 0.6), lens, sanitized ? 6 : 30);
  }
}

TEST(FlatNearField, OfAShellIsWhatLinesOfSightMeetInFlatSpace) {
  const std::string shell = "[[shells]]\nradius = 5\nfill_opacity = 1\nfill_color = [1, 1, 1]\nline_opacity = 0\n";
  compare_with_walk(flat_show(shell, above_the_plane, 1.0), LensChoice::direct, sanitized ? 8 : 40);
}

TEST(FlatNearField, OfAShellAboutTheCameraIsWhatLinesOfSightMeetInFlatSpace) {
  // The shell encloses the camera. Next to the hole, some lines of sight start in the shadow and
  // meet the far side of the shell.
  const std::string shell = "[[shells]]\nradius = 40\nfill_opacity = 1\nfill_color = [1, 1, 1]\nline_opacity = 0\n";
  const std::string hole_alone = "projection = \"pinhole\"\nfov_deg = 36\n";
  compare_with_walk(flat_show(shell, above_the_plane, 3.0, hole_alone), LensChoice::direct, sanitized ? 8 : 40);
}

TEST(FlatNearField, OfEyesFartherApartThanWhatTheySeeIsThatToo) {
  const std::string far = "[[camera.key]]\nr = 1000\ntheta_deg = 60\n[hole]\nspin = 0.9\n";
  const std::string near_the_hole = "projection = \"pinhole\"\nfov_deg = 5.5\n";
  compare_with_walk(flat_show(plain_disk, far, 60.0, near_the_hole), LensChoice::direct, sanitized ? 20 : 100);
}

TEST(FlatNearField, PutsDiskAndShellsInTheOrderOfTheirDistance) {
  const std::string both =
      "[[shells]]\nradius = 5\nfill_opacity = 1\nfill_color = [1, 1, 1]\nline_opacity = 0\n" + plain_disk;
  compare_with_walk(flat_show(both, above_the_plane, 1.0), LensChoice::direct, sanitized ? 8 : 20);
}

//! Returns the number of pixels in which two pictures differ by more than the fraction `part` of
//! their light.
long different(const Picture& a, const Picture& b, float part) {
  long count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const float one = luminance_of(light_at(a, x, y));
      const float other = luminance_of(light_at(b, x, y));
      count += std::abs(one - other) > part * std::max(one, other) + 1e-3F ? 1 : 0;
    }
  }
  return count;
}

TEST(FlatNearField, OfCloudsInAGridIsThatOfRays) {
  const Show show = flat_show(
      plain_disk + "pattern = \"procedural\"\ncontrast = 0.8\nlimb_darkening = true\n[effects]\nredshift = true\n",
      above_the_plane, 1.0);
  const auto rays = eyes_of(show, LensChoice::direct);
  const auto grid = eyes_of(show, LensChoice::live);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    EXPECT_LT(different(rays[eye], grid[eye], 0.1F), flat_px * flat_px / (sanitized ? 40 : 150)) << eye;
  }
  EXPECT_GT(different(grid[0], grid[1], 0.1F), flat_px * flat_px / 90);
}

TEST(FlatNearField, IsTheHeadsToTheBitWithoutABaseline) {
  const Show show = flat_show(plain_disk, above_the_plane, 0.0);
  const auto eyes = eyes_of(show, LensChoice::direct);
  Show head = show;
  head.stereo.layout = StereoLayout::mono;
  const auto one = eyes_of(head, LensChoice::direct);
  EXPECT_EQ(eyes[0].rgba, eyes[1].rgba);
  EXPECT_EQ(eyes[0].rgba, one[0].rgba);
}

TEST(FlatNearField, HasItsParallaxWhereEyesConvergeAndOnDomes) {
  // If the eyes converge at the distance of the hole, both see the hole at the same position, and
  // fewer pixels differ.
  for (const char* const view :
       {"projection = \"pinhole\"\nfov_deg = 60\n", "projection = \"dome\"\nfov_deg = 180\n"}) {
    Show show = flat_show(plain_disk, above_the_plane, 1.0, view);
    const auto apart = eyes_of(show, LensChoice::live);
    show.stereo.convergence = 24.0;
    const auto together = eyes_of(show, LensChoice::live);
    EXPECT_LT(different(together[0], together[1], 0.2F), different(apart[0], apart[1], 0.2F)) << view;
  }
}

//! Returns whether all values are finite and not negative. Because of rounding, the colors of
//! blackbodies may be slightly less than 0.
bool is_light(const Picture& picture) {
  return std::ranges::all_of(picture.rgba, [](float value) { return std::isfinite(value) && value > -1e-6F; });
}

TEST(FlatNearField, IsDrawnWhereverTheCameraIs) {
  // Cameras near the disk's plane, inside the disk's outer edge, on the spin axis, and far away.
  // For one of them, the baseline is larger than the distance to the disk's plane.
  const auto cameras =
      std::vector<std::string>{"[[camera.key]]\nr = 24\ntheta_deg = 90\n[hole]\nspin = 0.9\n",
                               "[[camera.key]]\nr = 24\ntheta_deg = 89.99\nroll_deg = 90\n[hole]\nspin = 1\n",
                               "observer = \"zamo\"\n[[camera.key]]\nr = 8\ntheta_deg = 85\n[hole]\nspin = 0.999\n",
                               "[[camera.key]]\nr = 30\ntheta_deg = 0\n[hole]\nspin = 0.5\n",
                               "[[camera.key]]\nr = 1e6\ntheta_deg = 60\n[hole]\nspin = 0.5\n"};
  for (const std::string& camera : cameras) {
    Show show = flat_show(plain_disk + "[[shells]]\nradius = 3\n[[shells]]\nradius = 20\n", camera, 0.4);
    show.view.size_px = 40;
    for (const Picture& eye : eyes_of(show, LensChoice::direct)) {
      EXPECT_TRUE(is_light(eye)) << camera;
    }
    Show disk = show;
    disk.shells.clear();
    for (const Picture& eye : eyes_of(disk, LensChoice::live)) {
      EXPECT_TRUE(is_light(eye)) << camera;
    }
  }
}

TEST(FlatNearField, CountsInTheDisparityThatAPersonReads) {
  const std::string shell = "[[shells]]\nradius = 5\n";
  Show show = flat_show(shell, above_the_plane, 1.0);
  show.sky.map = "milky_way";
  const CameraPose pose = camera_pose(show, 0.0);
  const Projection projection = make_projection(show.view, flat_px, 0.0);
  const auto disparity = frame_disparity(show, pose, projection, {}, {});
  ASSERT_TRUE(disparity);
  // The nearest point of the shell is straight ahead, where the lattice of samples has a point.
  const EyeCamera head = eye_camera(show, pose, 0.0);
  const double(&m)[3][3] = head.frame_from_view;
  const double distance = affine_distance(station_of(head), {-m[0][2], -m[1][2], -m[2][2]}, 5.0);
  const double half_width_px = 0.5 * projection.width_px;
  EXPECT_NEAR(disparity->min_px, -half_width_px / projection.pinhole.half_width / distance, 0.02);
  EXPECT_NEAR(disparity->max_px, 0.0, 1e-6);
  show.shells.clear();
  const auto sky_alone = frame_disparity(show, pose, projection, {}, {});
  ASSERT_TRUE(sky_alone);
  EXPECT_NEAR(sky_alone->min_px, 0.0, 1e-6);
}

}  // namespace
}  // namespace ergodome
