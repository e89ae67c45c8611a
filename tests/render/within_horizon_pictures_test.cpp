#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "content/show_reader.h"
#include "kernels/geodesic/taylor.h"
#include "kernels/shadow/shadow_chart.h"
#include "render/frame/show_renderer.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

constexpr const char* clouds =
    "[disk]\nouter = 14\npattern = \"procedural\"\nspeed = 2\nprofile = \"uniform\"\nplunging = true\ninner = 1.6\n";
constexpr const char* shells = "[[shells]]\nradius = 8\nline_width_deg = 4\nspacing_deg = 20\n";
constexpr const char* ball =
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nsize = 2\nretarded = true\n"
    "orbit = { r = 7, phi_deg = 40, speed = 2 }\n";

//! A camera that falls through the horizon of a hole of spin 0.9, at 1.4359 M, before a sky of few pixels and what else is said.
Show show_through(const std::string& more = "") {
  Show show = parse_show(
      "duration_s = 40\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 6\ntheta_deg = 70\n[camera.fall]\n"
      "velocity = { beta = 0.4, toward = [-3, 1, 1] }\nclock = 1\nleast_r = 0.8\n[effects]\nredshift = true\n"
      "[view]\nprojection = \"equirect\"\nfov_deg = 360\nsize_px = 128\n[stereo]\nbaseline = 0.1\n" +
          more,
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

TEST(WithinHorizonPictures, WhatStandsOutsideIsSeenOnWhereTheCameraFallsThroughIt) {
  for (const char* const what : {clouds, shells, ball}) {
    Show show = show_through(what);
    show.sky.exposure = 0.0;
    const double horizon_s = *show.camera.orbit->horizon_s();
    const auto before = light_at(show, horizon_s - 1e-5, LensChoice::direct);
    EXPECT_LT(change_of_light(before, light_at(show, horizon_s + 1e-5, LensChoice::direct)), 1e-2) << what;
    EXPECT_GT(change_of_light(before, light_at(show, horizon_s + 0.5, LensChoice::direct)), 3e-2) << what;
  }
}

TEST(WithinHorizonPictures, GridsOfADiskShowWhatRaysShow) {
  Show show = show_through("[disk]\nouter = 14\npattern = \"procedural\"\nspeed = 2\n");
  show.sky.exposure = 0.0;
  for (const double after_s : {-0.01, 0.01, 0.3, 1.0}) {
    const double time_s = *show.camera.orbit->horizon_s() + after_s;
    EXPECT_LT(change_of_light(light_at(show, time_s, LensChoice::direct), light_at(show, time_s, LensChoice::live)),
              1e-2)
        << after_s;
  }
}

//! Where on the sky an eye sees what is before it.
Vector3<double> sky_before(const EyeCamera& eye, const Vector3<double>& seen) {
  const CameraStation camera = make_camera_station(eye.spin, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  const auto part = [&](int i) {
    return eye.frame_from_view[i][0] * seen.x + eye.frame_from_view[i][1] * seen.y + eye.frame_from_view[i][2] * seen.z;
  };
  const RayStart<double> start = start_ray(camera, normalized({part(0), part(1), part(2)}));
  EXPECT_TRUE(comes_from_sky(eye.spin, camera.horizon_r, start));
  double steps = 0.0;
  bool reached = false;
  return turned_to_camera(camera, trace_taylor<20>(eye.spin, start, true, {1e-12, 1000}, steps, reached).sky);
}

double apart_on_sky(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> d = a - b;
  return std::sqrt(dot(d, d));
}

// One eye is farther in than the other, and they cross the horizon one after the other.
TEST(WithinHorizonPictures, EyesGoOnSeeingWhatTheySawWhereTheyFallThroughTheHorizon) {
  const Show show = show_through();
  const double horizon_s = *show.camera.orbit->horizon_s();
  const Vector3<double> away = {0.2, 0.3, 1.0};
  for (const double in : {-0.03, 0.0, 0.03}) {
    const auto seen_at = [&](double time_s) {
      return sky_before(eye_camera(show, camera_pose(show, time_s), Vector3<double>{0.0, 0.0, in}), away);
    };
    for (int i = -20; i < 20; ++i) {
      const double time_s = horizon_s + 0.005 * i;
      EXPECT_LT(apart_on_sky(seen_at(time_s), seen_at(time_s + 0.005)), 0.02) << in << ' ' << i;
    }
    // And not much else than the head does.
    EXPECT_LT(apart_on_sky(seen_at(horizon_s - 0.01),
                           sky_before(eye_camera(show, camera_pose(show, horizon_s - 0.01), 0.0), away)),
              0.1);
  }
}

}  // namespace
}  // namespace ergodome
