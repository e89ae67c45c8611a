#include <gtest/gtest.h>

#include <cmath>

#include "content/show/reading/show_reader.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {
namespace {

Show rain_show() {
  return parse_show(
      "duration_s = 20\n[camera]\n[camera.fall]\nclock = 2\nvelocity = \"rain\"\n[[camera.key]]\nr = 20\ntheta_deg = "
      "70\n",
      "rain.toml");
}

//! Returns the frequency ratio of light that was at rest at infinity, as seen by a falling eye in
//! the direction n of its own frame.
double frequency_ratio(const Show& show, double time_s, const Vector3<double>& n) {
  const EyeCamera eye = eye_camera(show, camera_pose(show, time_s), 0.0);
  const CameraStation station = make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  return 1.0 / start_ray<double>(station, n).energy;
}

// Frequency ratios for an observer in free fall from rest at infinity: 1 / (1 + √(2/r)) for light
// that comes from behind, 1 / (1 - √(2/r)) for light from ahead.
TEST(FallingEye, SeesItsOwnDopplerShiftAllTheWay) {
  const Show show = rain_show();
  for (const double time_s : {0.0, 5.0, 12.0, 18.0}) {
    const double fall = std::sqrt(2.0 / camera_pose(show, time_s).r);
    EXPECT_NEAR(frequency_ratio(show, time_s, {1.0, 0.0, 0.0}), 1.0 / (1.0 + fall), 1e-10);
    EXPECT_NEAR(frequency_ratio(show, time_s, {-1.0, 0.0, 0.0}), 1.0 / (1.0 - fall), 1e-9);
  }
}

TEST(FallingEye, MovesAsItsHeadDoes) {
  const Show show = rain_show();
  const CameraPose pose = camera_pose(show, 12.0);
  for (const double side : {-0.5, 0.5}) {
    const EyeCamera eye = eye_camera(show, pose, side);
    EXPECT_EQ(eye.velocity.x, pose.velocity->x);
    EXPECT_EQ(eye.motion, ObserverMotion::velocity);
  }
}

}  // namespace
}  // namespace ergodome
