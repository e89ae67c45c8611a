#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "content/show_reader.h"
#include "render/frame/show_renderer.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

//! A camera that falls through the horizon of a hole of spin 0.9, at 1.4359 M, before a sky of few pixels.
Show show_through() {
  Show show = parse_show(
      "duration_s = 40\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 6\ntheta_deg = 70\n[camera.fall]\n"
      "velocity = { beta = 0.4, toward = [-3, 1, 1] }\nclock = 1\nleast_r = 0.8\n[effects]\nredshift = true\n"
      "[view]\nprojection = \"equirect\"\nfov_deg = 360\nsize_px = 128\n[stereo]\nbaseline = 0.1\n",
      "through.toml");
  show.sky.map = test::tiny_sky();
  return show;
}

std::vector<float> light_at(const Show& show, double time_s, LensChoice lens) {
  ShowRenderer renderer(show, Backend::cpu, lens);
  const auto rgba = renderer.render(time_s, {ViewMode::sky, 128}).front().picture.rgba;
  return {rgba.begin(), rgba.end()};
}

//! Mean difference of two pictures over the mean light of the first.
double change_of_light(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  double light = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (i % 4 != 3) {
      sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      light += static_cast<double>(a[i]);
    }
  }
  return sum / light;
}

TEST(WithinHorizonPictures, NothingChangesWhereTheCameraFallsThroughIt) {
  const Show show = show_through();
  const double horizon_s = *show.camera.orbit->horizon_s();
  const auto before = light_at(show, horizon_s - 1e-5, LensChoice::direct);
  EXPECT_LT(change_of_light(before, light_at(show, horizon_s + 1e-5, LensChoice::direct)), 1e-3);
  EXPECT_GT(change_of_light(before, light_at(show, horizon_s + 0.5, LensChoice::direct)), 3e-2);
}

TEST(WithinHorizonPictures, GridsShowWhatRaysShow) {
  const Show show = show_through();
  for (const double time_s : {*show.camera.orbit->horizon_s() + 0.2, show.duration_s}) {
    EXPECT_LT(change_of_light(light_at(show, time_s, LensChoice::direct), light_at(show, time_s, LensChoice::live)),
              1e-2);
  }
}

TEST(WithinHorizonPictures, BothEyesGoOnAsTheyWereWhereTheirHeadFallsThroughTheHorizon) {
  // One eye is farther in than the other.
  Show show = show_through();
  for (CameraKey& key : show.camera.keys) {
    key.yaw = 1.2;
  }
  show.stereo.layout = StereoLayout::separate;
  const auto eyes_at = [&](double time_s) {
    ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
    std::vector<std::vector<float>> eyes;
    for (const FrameImage& image : renderer.render(time_s, {ViewMode::sky, 128})) {
      eyes.emplace_back(image.picture.rgba.begin(), image.picture.rgba.end());
    }
    return eyes;
  };
  const double horizon_s = *show.camera.orbit->horizon_s();
  const auto before = eyes_at(horizon_s - 0.15);
  const auto after = eyes_at(horizon_s + 0.15);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    EXPECT_LT(change_of_light(before.at(eye), after.at(eye)), 0.5) << eye;
  }
}

TEST(WithinHorizonPictures, EyesAreApartByTheirBaselineAndOnOneSide) {
  const Show show = show_through();
  const CameraPose pose = camera_pose(show, *show.camera.orbit->horizon_s() + 1e-3);
  // Of the rain's frame about a hole without spin space is flat; with one, r counts √A / Σ of a length.
  for (const double away : {-0.4, 0.4}) {
    const Vector3<double> outwards = {0.0, 0.0, away};
    const EyeCamera eye = eye_camera(show, pose, outwards);
    EXPECT_LE(eye.r, horizon_radius(0.9));
    EXPECT_EQ(eye.motion, ObserverMotion::rain_boost);
  }
  const EyeCamera right = eye_camera(show, pose, 0.05);
  const Vector3<double> way = place_of(right) - place_of(eye_camera(show, pose, 0.0));
  EXPECT_GT(dot(way, way), 1e-4);
}

}  // namespace
}  // namespace ergodome
