#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"
#include "render/eyes/eye_camera.h"
#include "tests/hard_cases/lens_methods.h"
#include "tests/hard_cases/ray_sets.h"

// Sets each input of a ray and of a show to NaN and to infinity. Such input must be refused or
// yield no sky, never a wrong but plausible sky.
namespace ergodome::test {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

void expect_no_sky_that_is_no_number(const SeenSky& seen) {
  for (std::size_t i = 0; i < seen.status.size(); ++i) {
    const double size = std::hypot(seen.sky[0][i], seen.sky[1][i], seen.sky[2][i]);
    ASSERT_TRUE(size == 0.0 || std::abs(size - 1.0) < 1e-3) << i << " " << size;
    ASSERT_EQ(size == 0.0, seen.status[i] != 0.0) << i;
  }
}

//! Returns a camera in which the number with the index `which` is replaced.
CameraState wild_position(int which, double value) {
  CameraState camera_state = {0.9, 8.0, 1.0, ObserverMotion::velocity, {0.1, 0.1, 0.1}};
  double* const numbers[] = {&camera_state.spin,   &camera_state.r,      &camera_state.theta,
                             &camera_state.beta.x, &camera_state.beta.y, &camera_state.beta.z};
  *numbers[which] = value;
  return camera_state;
}

TEST(WildInputs, OfACameraMakeNoSkyThatIsNoNumber) {
  const Directions rays = whole_sky(station_at({0.9, 8.0, 1.0}));
  for (int which = 0; which < 6; ++which) {
    for (const double value : {nan_value, infinite, -infinite}) {
      const CameraState camera_state = wild_position(which, value);
      for (const TraceMethod method :
           {TraceMethod::taylor, TraceMethod::cash_karp, TraceMethod::rk34, TraceMethod::baseline_rk34}) {
        SCOPED_TRACE(which);
        expect_no_sky_that_is_no_number(by_rays(camera_state, rays, method, 1e-6));
        expect_no_sky_that_is_no_number(by_float_rays(camera_state, rays, method, 1e-5));
      }
      expect_no_sky_that_is_no_number(by_rays(camera_state, rays, TraceMethod::closed_form, 1e-6));
    }
  }
}

TEST(WildInputs, OfADirectionSpoilThatRayAlone) {
  const CameraState camera_state = {0.9, 8.0, 1.0};
  for (const double value : {nan_value, infinite, -infinite}) {
    Directions rays = along_axes(station_at(camera_state));
    const SeenSky calm = by_rays(camera_state, rays, TraceMethod::taylor, 1e-9);
    rays[20].y = value;
    for (const TraceMethod method :
         {TraceMethod::taylor, TraceMethod::cash_karp, TraceMethod::rk34, TraceMethod::closed_form}) {
      const SeenSky seen = by_rays(camera_state, rays, method, 1e-9);
      expect_no_sky_that_is_no_number(seen);
      EXPECT_NE(seen.status[20], 0.0);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (i != 20) {
          ASSERT_EQ(seen.status[i], calm.status[i]) << i;
          ASSERT_NEAR(seen.sky[0][i], calm.sky[0][i], 1e-6) << i;
        }
      }
    }
    expect_no_sky_that_is_no_number(by_live_grid(camera_state, rays, Nodes::in_float));
    expect_no_sky_that_is_no_number(by_quadtree(camera_state, rays));
  }
}

//! Returns a show with an additional line in the given section.
std::string show_with(const std::string& section, const std::string& line) {
  const char* const base[][2] = {{"", "duration_s = 4\n"},
                                 {"hole", "[hole]\n"},
                                 {"camera", "[camera]\n"},
                                 {"key", "[[camera.key]]\n"},
                                 {"sky", "[sky]\nmap = \"grid\"\n"},
                                 {"view", "[view]\n"},
                                 {"stereo", "[stereo]\n"},
                                 {"quality", "[quality]\n"},
                                 {"tone", "[tone]\n"},
                                 {"disk", "[disk]\n"},
                                 {"shells", "[[shells]]\nradius = 30\n"}};
  std::string text;
  for (const auto& [name, begin] : base) {
    text += begin;
    if (section == name) {
      text += line;
    }
  }
  return text;
}

TEST(WildInputs, OfAShowAreRefusedWithTheirPlace) {
  const std::pair<const char*, const char*> numbers[] = {
      {"", "frame_rate_hz"},    {"hole", "spin"},          {"key", "r"},
      {"key", "theta_deg"},     {"key", "phi_deg"},        {"key", "yaw_deg"},
      {"key", "pitch_deg"},     {"key", "roll_deg"},       {"key", "t_s"},
      {"key", "hold_s"},        {"sky", "exposure"},       {"sky", "faintest_mag"},
      {"view", "fov_deg"},      {"view", "tilt_deg"},      {"view", "size_px"},
      {"stereo", "baseline"},   {"stereo", "convergence"}, {"stereo", "comfort_deg"},
      {"quality", "budget_px"}, {"tone", "exposure_stops"}};
  for (const auto& [section, key] : numbers) {
    for (const char* value : {"nan", "inf", "-inf"}) {
      try {
        parse_show(show_with(section, std::string(key) + " = " + value + "\n"), "show.toml");
        ADD_FAILURE() << key << " = " << value << " was taken";
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
        EXPECT_NE(error.location().find("show.toml"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(WildInputs, OfAPoseAreRefusedByAnEye) {
  const Show show = parse_show("[camera]\n[[camera.key]]\nr = 6\n", "show.toml");
  for (const double value : {nan_value, infinite, -infinite}) {
    CameraPose pose = camera_pose(show, 0.0);
    pose.r = value;
    EXPECT_THROW(eye_camera(show, pose, 0.0), Error) << "r " << value;
    pose = camera_pose(show, 0.0);
    EXPECT_THROW(eye_camera(show, pose, value), Error) << "offset " << value;
    pose.theta = value;
    EXPECT_THROW(eye_camera(show, pose, 0.0), Error) << "theta " << value;
  }
}

}  // namespace
}  // namespace ergodome::test
