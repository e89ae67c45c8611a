#include "render/lens/eye_camera.h"

#include <gtest/gtest.h>

#include "content/camera_path.h"
#include "content/show_reader.h"

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

}  // namespace
}  // namespace ergodome
