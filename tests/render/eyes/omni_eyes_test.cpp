#include "tests/render/omni_eyes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "render/frame/show_renderer.h"
#include "render/lens/omni_chooser.h"
#include "tests/render/stereo_scene.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): shows of tests

struct OmniErrors {
  double largest_px = 0.0;
  int compared = 0;
  int beyond = 0;  //!< number of pixels with errors of more than a fifth of a pixel
  //! Number of pixels that are dark instead of bright, or the reverse.
  int wrong = 0;
};

OmniErrors omni_errors(const Show& show, double half_baseline, double side, const Projection& projection,
                       double convergence, LensChoice choice) {
  const CameraPose pose = camera_pose(show, 0.0);
  const EyeAtOffset eye_at = [&](const Vector3<double>& offset) { return eye_camera(show, pose, offset); };
  const OmniSettings settings = {half_baseline, convergence, pi / 3.0, 0.5 * pi, 0.05 * pixel_angle(projection)};
  const auto cameras = std::make_shared<const OmniCamera>(Backend::cpu, eye_at, settings);
  const auto lens =
      OmniChooser(Backend::cpu).choose(make_omni_eye(cameras, side, eye_at), projection, ViewMode::sky, choice, {});
  const auto pixels = static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(projection.height_px);
  std::vector<float> values(14 * pixels);
  LensPixels out{};
  float* next = values.data();
  const auto take = [&] { return std::exchange(next, next + pixels); };
  for (int i = 0; i < 3; ++i) {
    out.sky[i] = take();
    out.sky_along_x[i] = take();
    out.sky_along_y[i] = take();
  }
  out.coverage = take();
  out.error_estimate = take();
  lens->fill(0, projection.height_px, out);
  OmniErrors errors;
  for (std::size_t at = 3; at < pixels; at += 7) {
    const auto width = static_cast<std::size_t>(projection.width_px);
    const std::size_t line = at / width;
    const double x_px = static_cast<double>(at - line * width) + 0.5;
    const double y_px = static_cast<double>(line) + 0.5;
    if (image_coverage(projection, x_px, y_px) < 1.0) {
      continue;
    }
    const Vector3<double> view = direction_from_pixel(projection, x_px, y_px);
    const auto [camera, n] = test::direct_ray(eye_at, view, side * half_baseline, convergence);
    const bool bright = direction_is_bright(camera, n);
    const float covered = out.coverage[at];
    if (covered > 0.0F && covered < 1.0F) {
      continue;  // on the edge, which is checked separately
    }
    errors.wrong += bright != (covered > 0.5F) ? 1 : 0;
    if (!bright || covered < 1.0F || out.error_estimate[at] < 0.0F) {
      continue;
    }
    const auto vector = [&](float* const(&channel)[3]) {
      return Vector3<double>{channel[0][at], channel[1][at], channel[2][at]};
    };
    const Vector3<double> missing = vector(out.sky) - test::exact_sky(camera, n);
    const Vector3<double> along_x = vector(out.sky_along_x);
    const Vector3<double> along_y = vector(out.sky_along_y);
    const double a = dot(along_x, along_x);
    const double b = dot(along_x, along_y);
    const double c = dot(along_y, along_y);
    const double p = dot(along_x, missing);
    const double q = dot(along_y, missing);
    const double determinant = a * c - b * b;
    // Skips pixels near a caustic: if the sky moves by less than a twentieth of the motion on the
    // screen, the sky direction does not determine the position on the screen.
    const double larger = std::sqrt(0.5 * (a + c + std::sqrt(std::max((a + c) * (a + c) - 4.0 * determinant, 0.0))));
    if (std::sqrt(std::max(determinant, 0.0)) > 0.05 * larger * pixel_angle(projection)) {
      const double error_px = std::hypot(c * p - b * q, a * q - b * p) / determinant;
      errors.largest_px = std::max(errors.largest_px, error_px);
      errors.beyond += error_px > 0.2 ? 1 : 0;
      ++errors.compared;
    }
  }
  return errors;
}

void expect_omni(const Show& show, double half_baseline, const Projection& projection, double convergence = 0.0,
                 const std::vector<LensChoice>& choices = {LensChoice::direct, LensChoice::live}) {
  for (const LensChoice choice : choices) {
    for (const double side : {-1.0, 1.0}) {
      SCOPED_TRACE(choice == LensChoice::live ? "by a grid" : "by rays");
      const OmniErrors errors = omni_errors(show, half_baseline, side, projection, convergence, choice);
      // The error of a grid is checked only at sample points when it is built. Between these, next
      // to the edge of the shadow, a few pixels exceed the limit.
      const int may_be = choice == LensChoice::live ? 1 + errors.compared / 1000 : 0;
      EXPECT_LE(errors.beyond, may_be) << half_baseline << " " << side;
      EXPECT_LT(errors.largest_px, may_be > 0 ? 1.0 : 0.2) << half_baseline << " " << side;
      EXPECT_EQ(errors.wrong, 0) << half_baseline << " " << side;
      EXPECT_GT(errors.compared, 100);
    }
  }
}

TEST(OmniEyes, AgreeWithDirectRaysFromEachPixelsOwnCamera) {
  const Show show = show_of_eyes("model = \"omni\"\n");
  for (const double half : {5e-5, 0.05, 0.5}) {
    expect_omni(show, half, make_dome_projection(256, pi, 0.4));
  }
  if (!test::sanitized) {
    // The picture is so large that its lens is read from a grid.
    expect_omni(show, 0.5, make_dome_projection(512, pi, 0.4), 0.0, {LensChoice::live});
  }
  expect_omni(show, 0.5, make_equirectangular_projection(256, 128));
  expect_omni(show, 0.5, make_cylinder_projection(256, 82, 2.0 * pi, -1.0, 1.0));
  expect_omni(show, 0.5, make_cube_projection(64, CubeLayout::strip));
}

TEST(OmniEyes, AgreeForEyesThatConverge) {
  expect_omni(show_of_eyes("model = \"omni\"\n"), 0.5, make_dome_projection(256, pi, 0.4), 12.0);
}

TEST(OmniEyes, AgreeFarApart) {
  expect_omni(show_of_eyes("model = \"omni\"\n", "", "r = 30\ntheta_deg = 70\n"), 4.0,
              make_dome_projection(256, pi, 0.4));
}

TEST(OmniEyes, AgreeOnTheSpinAxis) {
  expect_omni(show_of_eyes("model = \"omni\"\n", "", "r = 9\ntheta_deg = 0\n"), 0.2,
              make_dome_projection(256, pi, 0.4));
}

TEST(OmniEyes, AreRefusedWhereNoCamerasLie) {
  const Show show = show_of_eyes("model = \"omni\"\n");
  const EyeAtOffset eye_at = [&](const Vector3<double>& offset) {
    return eye_camera(show, camera_pose(show, 0.0), offset);
  };
  EXPECT_THROW(OmniCamera(Backend::cpu, eye_at, {20.0}), Error);
}

}  // namespace
}  // namespace ergodome
