#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/objects/path_step.h"
#include "kernels/spacetime/geodesic/radial_potential.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/frame/show_renderer.h"
#include "tests/render/omni_eyes.h"
#include "tests/support/errors.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

constexpr const char* clouds =
    "[disk]\nouter = 14\npattern = \"procedural\"\nspeed = 2\nprofile = \"uniform\"\nplunging = true\ninner = 1.6\n";
constexpr const char* shells = "[[shells]]\nradius = 8\nline_width_deg = 4\nspacing_deg = 20\n";
constexpr const char* ball =
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nsize = 2\nretarded = true\n"
    "orbit = { r = 7, phi_deg = 40, speed = 2 }\n";

//! Returns a show with a tiny sky map and the given additional lines. Its camera falls through the
//! horizon of a hole with spin 0.9, at 1.4359 M.
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

//! Returns the mean difference of two pictures relative to the mean light of the first.
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

TEST(WithinHorizonPictures, HeatMapsRefuseTheMethodWhoseCoordinatesEndThere) {
  const Show show = show_through();
  ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
  const auto problem = [&](TraceMethod method, double after_s) {
    return test::error_of([&] {
      renderer.render(*show.camera.orbit->horizon_s() + after_s, {ViewMode::steps, 16, method});
    });
  };
  EXPECT_THAT(problem(TraceMethod::baseline_rk34, 0.1), testing::HasSubstr("taylor, rk34 or cash_karp"));
  EXPECT_EQ(problem(TraceMethod::baseline_rk34, -0.1), "");
  EXPECT_EQ(problem(TraceMethod::cash_karp, 0.1), "");
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

//! Returns the sky direction that an eye sees in the view direction `seen`.
Vector3<double> sky_before(const EyeCamera& eye, const Vector3<double>& seen) {
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  const auto part = [&](int i) {
    return eye.frame_from_view[i][0] * seen.x + eye.frame_from_view[i][1] * seen.y + eye.frame_from_view[i][2] * seen.z;
  };
  const RayStart<double> start = start_ray(camera, normalized({part(0), part(1), part(2)}));
  EXPECT_TRUE(comes_from_sky(eye.spacetime.spin, camera.horizon_r, start));
  double steps = 0.0;
  bool reached = false;
  return turned_to_camera(camera, trace_taylor<20>(eye.spacetime.spin, start, true, {1e-12, 1000}, steps, reached).sky);
}

double apart_on_sky(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> d = a - b;
  return std::sqrt(dot(d, d));
}

// The eyes are at different radii, so they cross the horizon one after the other.
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
    // The eye sees nearly the same part of the sky as the head does.
    EXPECT_LT(apart_on_sky(seen_at(horizon_s - 0.01),
                           sky_before(eye_camera(show, camera_pose(show, horizon_s - 0.01), 0.0), away)),
              0.1);
  }
}

//! Where a ray comes from a point in the equatorial plane: the point in pseudo-Cartesian
//! coordinates, and the delay of the light in the time of ingoing Kerr coordinates. All are 0 if
//! the ray does not meet the plane.
struct PlaneSight {
  double x, y, delay;
};

PlaneSight plane_sight(double spin, const NearRay<double>& ray, double phi, double lag) {
  EquatorialCrossing<double> found[crossing_orders];
  trace_crossings<20, true>(spin, ray, {1e-3, 1e-13, 1000}, true, found);
  const EquatorialCrossing<double>& c = found[0];
  if (!(c.u > 0.0)) {
    return {0.0, 0.0, 0.0};
  }
  const double azimuth = std::atan2(c.y, c.x) + c.drag + phi;
  return {std::cos(azimuth) / c.u, std::sin(azimuth) / c.u, c.delay - lag};
}

//! Computes the same as plane_sight(), from the path that is used to search for objects. Such a
//! path may start between the camera and the horizon.
PlaneSight path_sight(double spin, const NearRay<double>& ray, double phi, double lag) {
  PlaneSight found{};
  follow_path<16, NearParts::azimuth_and_delay>(
      spin, std::cos(phi), std::sin(phi), ray, {horizon_radius(Spacetime{spin}) * (1.0 + 1e-6), 40.0}, {1e-13, 1000},
      true, [&](int, const PathStep<16, NearParts::azimuth_and_delay, double>& step) {
        const auto height = [&](double h) { return step.point(h).z; };
        const bool meets = height(0.0) * height(step.length) < 0.0;
        if (meets) {
          const double h = detail::time_to_zero(step.series.z, height(0.0), 0.0, step.length);
          found = {step.point(h).x, step.point(h).y, step.delay(h) - lag};
        }
        return meets;
      });
  return found;
}

//! Eyes of the stereo model `omni` whose cameras are on both sides of the horizon.
class OmniEyesWithin {
 public:
  OmniEyesWithin(const Show& show, double time_s)
      : show_(show),
        pose_(camera_pose(show, time_s)),
        head_(eye_at({0.0, 0.0, 0.0})),
        cameras_(Backend::cpu, [this](const Vector3<double>& offset) { return eye_at(offset); },
                 {half_baseline, 0.0, pi / 3.0, 0.5 * pi, 1e-6}) {}

  //! Compares what the omnidirectional eye sees in a direction with what a single camera at the
  //! position for this direction sees. Returns whether that is the sky.
  bool compare(const Vector3<double>& view, double side) const {
    const auto [camera, n] = test::direct_ray([this](const Vector3<double>& offset) { return eye_at(offset); }, view,
                                              side * half_baseline, 0.0);
    const OmniCameraOf<double> omni = cameras_.exact(side);
    const RayStart<double> own = start_ray(camera, n);
    const RayStart<double> seen = start_ray(omni, view);
    // Skips directions near the edge of the shadow, where tiny differences grow large.
    const double dark = darkness(show_.spin, camera.horizon_r, own);
    if (std::abs(dark) < 0.05) {
      return false;
    }
    EXPECT_EQ(dark < 0.0, comes_from_sky(show_.spin, camera.horizon_r, seen));
    const double own_phi = std::atan2(camera.sine_phi, camera.cosine_phi);
    if (dark < 0.0) {
      EXPECT_LT(apart_on_sky(sky_of(own, own_phi), sky_of(seen, head_.phi)), 1e-4);
    }
    const PlaneSight a = plane_sight(show_.spin, start_near_ray(camera, n), own_phi, camera.lag);
    const PlaneSight b = plane_sight(show_.spin, start_near_ray(omni, view), head_.phi, omni.lag);
    const PlaneSight c = path_sight(show_.spin, start_near_ray(omni, view), head_.phi, omni.lag);
    const double r = std::hypot(a.x, a.y);
    // Skips points at the horizon, where azimuths diverge, and far points.
    if (r > (own.u_rate < 0.0 ? 1.7 : 1.03 * camera.horizon_r) && r < 30.0) {
      EXPECT_LT(std::hypot(a.x - c.x, a.y - c.y), 1e-3 * r);
      EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 1e-3 * r);
      if (own.u_rate < 0.0) {
        EXPECT_NEAR(a.delay, c.delay, 1e-3 * r);
        EXPECT_NEAR(a.delay, b.delay, 1e-3 * r);
      }
    }
    return dark < 0.0;
  }

  //! Returns whether an eye sees, in a direction, a point of the equatorial plane that is between
  //! the eye and the horizon.
  [[nodiscard]] bool sees_plane_beneath(const Vector3<double>& view, double side) const {
    const NearRay<double> ray = start_near_ray(cameras_.exact(side), view);
    const PlaneSight seen = plane_sight(show_.spin, ray, head_.phi, 0.0);
    return ray.u_rate > 0.0 && std::hypot(seen.x, seen.y) > 1.05 * horizon_radius(spacetime_of(show_));
  }

 private:
  static constexpr double half_baseline = 0.02;

  [[nodiscard]] EyeCamera eye_at(const Vector3<double>& offset) const { return eye_camera(show_, pose_, offset); }

  [[nodiscard]] Vector3<double> sky_of(const RayStart<double>& start, double phi) const {
    double steps = 0.0;
    bool reached = false;
    const Vector3<double> sky = trace_taylor<20>(show_.spin, start, true, {1e-12, 1000}, steps, reached).sky;
    return {std::cos(phi) * sky.x - std::sin(phi) * sky.y, std::sin(phi) * sky.x + std::cos(phi) * sky.y, sky.z};
  }

  const Show& show_;
  CameraPose pose_;
  EyeCamera head_;
  OmniCamera cameras_;
};

TEST(WithinHorizonPictures, EyesThatTurnSeeOnBothSidesWhatEachDirectionsOwnCameraSees) {
  const Show show = show_through();
  for (const double after_s : {-0.1, -0.005, 0.005, 0.1, 2.0}) {
    SCOPED_TRACE(after_s);
    const OmniEyesWithin eyes(show, *show.camera.orbit->horizon_s() + after_s);
    int bright = 0;
    for (int i = 0; i < 200; ++i) {
      const double y = -0.98 + 1.96 * i / 199.0;
      const double level = std::sqrt(1.0 - y * y);
      const Vector3<double> view = {level * std::sin(2.39996 * i), y, -level * std::cos(2.39996 * i)};
      bright += eyes.compare(view, i % 2 == 0 ? 1.0 : -1.0) ? 1 : 0;
    }
    EXPECT_GT(bright, 30);
  }
}

// The azimuth of points between an eye and the horizon is that of the eye in Boyer-Lindquist
// coordinates, not that of the head in ingoing Kerr coordinates.
TEST(WithinHorizonPictures, EyesThatTurnSeeWhatIsBeneathThemBesideTheHorizon) {
  const Show show = show_through();
  const OmniEyesWithin eyes(show, *show.camera.orbit->horizon_s() - 0.21);
  int beneath = 0;
  for (int i = 0; i < 1500; ++i) {
    const double y = -0.98 + 1.96 * i / 1499.0;
    const double level = std::sqrt(1.0 - y * y);
    const Vector3<double> view = {level * std::sin(2.39996 * i), y, -level * std::cos(2.39996 * i)};
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    if (eyes.sees_plane_beneath(view, side)) {
      eyes.compare(view, side);
      ++beneath;
    }
  }
  EXPECT_GT(beneath, 5);
}

}  // namespace
}  // namespace ergodome
