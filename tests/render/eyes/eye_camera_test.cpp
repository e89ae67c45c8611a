#include "render/eyes/eye_camera.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "render/lens/stations/lens_position.h"
#include "render/passes/stars/star_eye.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

TEST(EyeCameras, OfTheHeadAreWhereItIsToTheLastBitAllTheWayRound) {
  const Show show = parse_show("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 5\ntheta_deg = 70\n", "show.toml");
  CameraPose pose = camera_pose(show, 0.0);
  for (int i = 0; i < 2000; ++i) {
    pose.phi += 0.0031;
    const EyeCamera eye = eye_camera(show, pose, 0.0);
    ASSERT_EQ(eye.r, pose.r) << pose.phi;
    ASSERT_EQ(eye.theta, pose.theta) << pose.phi;
  }
}

//! A head that moves around the hole, with two eyes side by side.
class EyesOfAHeadThatGoesRound : public testing::TestWithParam<double> {
 protected:
  [[nodiscard]] CameraPose pose_at(double time_s) const { return camera_pose(show_, time_s); }

  [[nodiscard]] StarEye omni_at(double time_s, double side) const {
    const EyeAtOffset eye_at = [this, pose = pose_at(time_s)](const Vector3<double>& offset) {
      return eye_camera(show_, pose, offset);
    };
    const OmniSettings settings = {0.1, 20.0, pi / 3.0, 0.5 * pi, 1e-4};
    return StarEye(make_omni_eye(std::make_shared<const OmniCamera>(Backend::cpu, eye_at, settings), side, eye_at));
  }

  Show show_ = parse_show(fmt::format("duration_s = 10\n[hole]\nspin = 0.999\n[camera]\nobserver = \"zamo\"\n"
                                      "[[camera.key]]\nr = {0}\ntheta_deg = 70\n"
                                      "[[camera.key]]\nt_s = 10\nr = {0}\ntheta_deg = 70\nphi_deg = 200\n",
                                      GetParam()),
                          "show.toml");
};

TEST_P(EyesOfAHeadThatGoesRound, AreInOnePosition) {
  const EyeCamera first = eye_camera(show_, pose_at(0.0), 0.1);
  for (double time_s = 0.0; time_s < 10.0; time_s += 0.013) {
    const EyeCamera eye = eye_camera(show_, pose_at(time_s), 0.1);
    ASSERT_TRUE(same_position({first.r, first.theta}, {eye.r, eye.theta})) << time_s;
  }
}

TEST_P(EyesOfAHeadThatGoesRound, AreServedByOneGridWhereTheyTurnWithTheSight) {
  const StarEye first = omni_at(0.0, 1.0);
  for (double time_s = 0.2; time_s < 10.0; time_s += test::sanitized ? 4.0 : 0.4) {
    ASSERT_TRUE(served_alike(first, omni_at(time_s, 1.0))) << time_s;
  }
}

TEST_P(EyesOfAHeadThatGoesRound, ShareAPlaceWhereItLooksAtTheHole) {
  const EyeCamera left = eye_camera(show_, pose_at(3.0), -0.1);
  const EyeCamera right = eye_camera(show_, pose_at(3.0), 0.1);
  EXPECT_TRUE(same_position({left.r, left.theta}, {right.r, right.theta}));
}

TEST_P(EyesOfAHeadThatGoesRound, AreTwoWhereTheyTurnWithTheSight) {
  EXPECT_FALSE(served_alike(omni_at(0.0, -1.0), omni_at(0.0, 1.0)));
}

TEST_P(EyesOfAHeadThatGoesRound, AreElsewhereWhereItComesNearer) {
  CameraPose nearer = pose_at(0.0);
  nearer.r -= 1e-6;
  const EyeCamera eye = eye_camera(show_, pose_at(0.0), 0.1);
  const EyeCamera moved = eye_camera(show_, nearer, 0.1);
  EXPECT_FALSE(same_position({eye.r, eye.theta}, {moved.r, moved.theta}));
}

INSTANTIATE_TEST_SUITE_P(Of, EyesOfAHeadThatGoesRound, testing::Values(1.2, 5.0, 500.0));

}  // namespace
}  // namespace ergodome
