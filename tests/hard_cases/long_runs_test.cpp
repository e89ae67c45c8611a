#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/eyes/eye_camera.h"
#include "tests/hard_cases/miss.h"
#include "tests/hard_cases/random_cameras.h"
#include "tests/support/sanitized.h"

// Checks that no frame jumps, at 60 frames per second, for cameras that move for a long time or
// pass through coordinate singularities. A test observes the sky positions of fixed view
// directions. A parabola through the three previous frames predicts smooth motion. The difference
// from this prediction, converted to a displacement on the screen, is the jump.
namespace ergodome::test {
namespace {

constexpr double frame_s = 1.0 / 60.0;

//! The largest allowed jump [px of a 4096² dome]: the default lens budget of shows.
constexpr double budget_px = 0.25;

//! Returns random view directions over the whole sphere, the same in each call.
Directions view_directions() {
  std::mt19937_64 random(3);
  Directions all(sanitized ? 20 : 150);
  for (Vector3<double>& v : all) {
    v = any_direction(random);
  }
  return all;
}

Vector3<double> in_frame(const EyeCamera& eye, const Vector3<double>& v) {
  const auto row = [&](int i) {
    return eye.frame_from_view[i][0] * v.x + eye.frame_from_view[i][1] * v.y + eye.frame_from_view[i][2] * v.z;
  };
  return {row(0), row(1), row(2)};
}

CameraStation station_of_eye(const EyeCamera& eye) {
  return make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
}

//! Returns the exact lens of a frame in the view directions.
std::vector<ExactRay> lens_of(const EyeCamera& eye) {
  Directions rays;
  for (const Vector3<double>& v : view_directions()) {
    rays.push_back(normalized(in_frame(eye, v)));
  }
  return exact_rays(station_of_eye(eye), rays);
}

//! Returns the ratio of an area on the sky to the small area of the screen that shows it.
double area(const ExactRay& ray) {
  const Vector3<double> normal = cross(ray.along[0], ray.along[1]);
  return std::sqrt(dot(normal, normal));
}

//! Returns the largest jump in `frames` frames from `begin_s` on, in pixels of a 4096² dome.
double largest_leap_px(const std::function<EyeCamera(double time_s)>& eye_at, double begin_s, int frames) {
  std::array<std::vector<ExactRay>, 4> last;
  double largest = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    last[0] = std::move(last[1]);
    last[1] = std::move(last[2]);
    last[2] = std::move(last[3]);
    last[3] = lens_of(eye_at(begin_s + frame * frame_s));
    if (frame < 3) {
      continue;
    }
    for (std::size_t i = 0; i < last[2].size(); ++i) {
      const bool seen = last[0][i].bright && last[1][i].bright && last[2][i].bright && last[3][i].bright;
      // Skips directions where the sky winds around the hole within a pixel, and directions on a
      // caustic: there, differences between frames do not approximate rates of change.
      if (seen && last[2][i].stretch < 10.0 && area(last[2][i]) > 0.1) {
        const Vector3<double> leap = last[3][i].sky - 3.0 * last[2][i].sky + 3.0 * last[1][i].sky - last[0][i].sky;
        largest = std::max(largest, displacement(last[2][i], leap) / dome_pixel);
      }
    }
  }
  return largest;
}

Show show_of(const std::string& text) { return parse_show(text, "show.toml"); }

EyeCamera eye_of(const Show& show, double time_s, double to_the_right = 0.0) {
  const Show now = show_at(show, time_s);
  return eye_camera(now, camera_pose(now, time_s), to_the_right);
}

//! A show with a circular orbit that has a period of 20 s and lasts for a million periods.
const char* const endless_orbit = R"(
duration_s = 20_000_000
[hole]
spin = 0.9
[camera]
observer = "geodesic"
[[camera.key]]
t_s = 0
r = 8
ease = "linear"
[[camera.key]]
t_s = 20_000_000
r = 8
phi_deg = 360_000_000
)";

TEST(LongRun, AMillionPeriodsOfAnOrbitEndWhereTheyBegan) {
  const Show show = show_of(endless_orbit);
  for (const double periods : {1.0, 1e3, 1e6 - 1.0}) {
    for (const double t : {0.0, 3.7, 11.1}) {
      const std::vector<ExactRay> first = lens_of(eye_of(show, t));
      const std::vector<ExactRay> last = lens_of(eye_of(show, t + 20.0 * periods));
      for (std::size_t i = 0; i < first.size(); ++i) {
        ASSERT_EQ(first[i].bright, last[i].bright);
        if (first[i].bright && first[i].stretch < winding_stretch) {
          EXPECT_LT(displacement(first[i], last[i].sky - first[i].sky) / dome_pixel, 0.01) << periods;
        }
      }
    }
  }
}

TEST(LongRun, TheMillionthPeriodIsAsSmoothAsTheFirst) {
  const Show show = show_of(endless_orbit);
  const auto eye = [&](double time_s) { return eye_of(show, time_s); };
  EXPECT_LT(largest_leap_px(eye, 0.0, 20), budget_px);
  EXPECT_LT(largest_leap_px(eye, 20.0 * (1e6 - 1.0), 20), budget_px);
}

TEST(LongRun, ABaselineGrowsFromNoneToTwiceTheDistance) {
  const Show show = show_of("[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 6\ntheta_deg = 70\n");
  // The baseline grows from 0 to 12 M in ten seconds, so each eye moves by 6 M; it starts and ends
  // slowly.
  for (const double side : {-1.0, 1.0}) {
    const auto eye = [&](double time_s) {
      const double part = 0.5 - 0.5 * std::cos(pi * time_s / 10.0);
      return eye_camera(show, camera_pose(show, 0.0), side * 6.0 * part);
    };
    EXPECT_LT(largest_leap_px(eye, 0.0, sanitized ? 30 : 600), budget_px);
  }
}

//! Returns a show in which the spin changes from one value to another within four seconds. `keys`
//! are its animation keys.
Show spin_show(const std::string& keys) {
  return show_of(
      "duration_s = 4\n[camera]\n[[camera.key]]\nr = 6\ntheta_deg = 80\n[[animate]]\nnumber = \"hole.spin\"\nkey = " +
      keys + "\n");
}

TEST(LongRun, SpinGoesThroughNone) {
  const Show show = spin_show("[{ t_s = 0, value = -0.3 }, { t_s = 4, value = 0.3 }]");
  EXPECT_LT(largest_leap_px([&](double t) { return eye_of(show, t); }, 1.5, 60), budget_px);
}

TEST(LongRun, SpinComesToOneAndGoesBack) {
  for (const double end : {1.0, -1.0}) {
    const Show show = spin_show(fmt::format(
        "[{{ t_s = 0, value = {0} }}, {{ t_s = 2, value = {1} }}, {{ t_s = 4, value = {0} }}]", 0.9 * end, end));
    ASSERT_EQ(spacetime_at(show, 2.0).spin, end);
    EXPECT_LT(largest_leap_px([&](double t) { return eye_of(show, t); }, 1.5, 60), budget_px) << end;
  }
}

//! Returns a camera on the sphere r = 6 that moves over the north pole at 0.05 rad/s, or passes it
//! at a distance of `beside` radians. The axes of the view keep their directions.
EyeCamera over_the_axis(double time_s, double beside) {
  const double x = 0.05 * time_s;
  EyeCamera eye{
      Spacetime{0.9}, 6.0, std::hypot(x, beside), std::atan2(beside, x), ObserverMotion::zamo, {}, {}, 6.0, 0.0};
  eye.head_theta = eye.theta;
  const double along = std::cos(eye.phi);
  const double across = std::sin(eye.phi);
  const double frame[3][3] = {{0.0, 0.0, 1.0}, {along, across, 0.0}, {-across, along, 0.0}};
  std::copy(&frame[0][0], &frame[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

TEST(LongRun, APathLeadsThroughTheAxis) {
  for (const double beside : {0.0, 1e-12, 1e-9, 1e-3}) {
    // In frame 20, the camera is exactly on the spin axis.
    EXPECT_LT(largest_leap_px([&](double t) { return over_the_axis(t - 20 * frame_s, beside); }, 0.0, 40), budget_px)
        << beside;
  }
}

//! Returns a camera that moves along θ through the equator. There grids change from whole grids to
//! mirrored halves and back.
EyeCamera through_the_equator(double time_s) {
  EyeCamera eye{Spacetime{0.999}, 5.0, 0.5 * pi + 0.05 * time_s, 0.0, ObserverMotion::zamo, {}, {}, 5.0, 0.5 * pi};
  const double frame[3][3] = {{0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}};
  std::copy(&frame[0][0], &frame[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

TEST(LongRun, APathLeadsThroughTheEquator) {
  EXPECT_LT(largest_leap_px([](double t) { return through_the_equator(t - 20 * frame_s); }, 0.0, 40), budget_px);
}

TEST(LongRun, LiveGridsLeapByNoMoreThanTheirBudgetWhereTheyTurnIntoMirroredOnes) {
  // Each frame builds a new grid, so the error of the grid changes abruptly from frame to frame.
  std::vector<double> leaps;
  std::vector<Vector3<double>> last;
  for (int frame = -3; frame <= 3; ++frame) {
    const EyeCamera eye = through_the_equator(frame * frame_s);
    ASSERT_EQ(eye.theta == 0.5 * pi, frame == 0);
    const CameraState camera_state = {eye.spacetime.spin, eye.r, eye.theta};
    Directions rays;
    for (const Vector3<double>& v : view_directions()) {
      rays.push_back(normalized(in_frame(eye, v)));
    }
    const SeenSky seen = by_live_grid(camera_state, rays, Nodes::in_double);
    const std::vector<ExactRay> exact = exact_rays(station_at(camera_state), rays);
    std::vector<Vector3<double>> misses(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      misses[i] = {seen.sky[0][i] - exact[i].sky.x, seen.sky[1][i] - exact[i].sky.y, seen.sky[2][i] - exact[i].sky.z};
      if (!last.empty() && exact[i].bright && exact[i].stretch < winding_stretch) {
        leaps.push_back(displacement(exact[i], misses[i] - last[i]) / dome_pixel);
      }
    }
    last = std::move(misses);
  }
  std::sort(leaps.begin(), leaps.end());
  EXPECT_LT(leaps[leaps.size() * 99 / 100], sanitized ? 10.0 * budget_px : budget_px);
}

}  // namespace
}  // namespace ergodome::test
