#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/frame/show_renderer.h"
#include "render/stereo/eye_disparity.h"
#include "tests/render/omni_eyes.h"
#include "tests/render/stereo_scene.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): shows of tests

//! Returns the column of the left side of the shadow in a row [px]. It equals the amount of light
//! to the left of the picture's middle.
double left_side(const Picture& picture, int row) {
  double sum = 0.0;
  for (int x = 0; x < picture.width / 2; ++x) {
    sum += static_cast<double>(coverage_at(picture, x, row));
  }
  return sum;
}

//! Returns the column of the left side of the shadow in a row [px], computed from the critical
//! curve of a camera at the event of the eye.
double left_side_of_curve(const EyeCamera& eye, const Projection& projection, int row) {
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
  const ShadowChart chart = make_shadow_chart(camera);
  const auto pixel_at = [&](double gamma, double& x, double& y) {
    const double alpha = edge_polar_angle(camera, chart, gamma);
    const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
    ASSERT_TRUE(pixel_from_direction(projection, in_view(eye, n), x, y));
  };
  double leftmost = 1e9;
  double x0 = 0.0;
  double y0 = 0.0;
  pixel_at(0.0, x0, y0);
  constexpr int steps = 4096;
  for (int i = 1; i <= steps; ++i) {
    double x = 0.0;
    double y = 0.0;
    pixel_at(2.0 * pi * i / steps, x, y);
    const double middle = row + 0.5;
    if ((y0 - middle) * (y - middle) <= 0.0 && y != y0) {
      leftmost = std::min(leftmost, x0 + (middle - y0) / (y - y0) * (x - x0));
    }
    x0 = x;
    y0 = y;
  }
  return leftmost;
}

void expect_disparity_of_direct_cameras(ShowRenderer& renderer, double baseline) {
  StereoSettings stereo = renderer.show().stereo;
  stereo.baseline = baseline;
  renderer.set_stereo(stereo);
  const auto eyes = renderer.render(0.0, {});
  const Show& show = renderer.show();
  const CameraPose pose = camera_pose(show, 0.0);
  const Projection projection = make_projection(show.view, 400, 0.0);
  for (const int row : {150, 200, 250}) {
    const double ours = left_side(eyes[0].picture, row) - left_side(eyes[1].picture, row);
    const double expected = left_side_of_curve(eye_camera(show, pose, -0.5 * baseline), projection, row) -
                            left_side_of_curve(eye_camera(show, pose, 0.5 * baseline), projection, row);
    EXPECT_NEAR(ours, expected, 0.1) << baseline << " row " << row;
    EXPECT_GT(expected, 0.0);
  }
}

TEST(PhysicalEyes, HaveTheDisparityOfDirectCamerasAtTheShadowsEdge) {
  for (const LensChoice lens : {LensChoice::direct, LensChoice::live}) {
    ShowRenderer renderer(show_of_eyes(""), Backend::cpu, lens);
    for (const double baseline :
         test::sanitized ? std::vector<double>{1e-2, 1.0} : std::vector<double>{1e-4, 1e-3, 1e-2, 0.1, 1.0}) {
      expect_disparity_of_direct_cameras(renderer, baseline);
    }
  }
}

TEST(PhysicalEyes, ThatAreMadeInTurnAreThoseThatAreMadeAlone) {
  // The picture consists of two blocks of rows, each with several strips.
  Show show = show_of_eyes("baseline = 0.5\n");
  show.sky.stars = "bright_stars";
  show.effects.redshift = true;
  const CameraPose pose = camera_pose(show, 0.0);
  for (const double convergence : {0.0, 12.0}) {
    show.stereo.convergence = convergence;
    ShowRenderer renderer(show, Backend::cpu, LensChoice::live);
    const Projection projection = make_projection(show.view, 400, 0.0);
    const auto eyes = renderer.render_window_parts(pose, projection, ViewMode::sky);
    ASSERT_EQ(eyes.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const double offset = (i == 0 ? -0.5 : 0.5) * show.stereo.baseline;
      const Picture alone =
          renderer.render_eye(pose, offset, converged_projection(projection, offset, convergence), ViewMode::sky);
      EXPECT_EQ(eyes[i].lens, std::string("live"));
      EXPECT_EQ(eyes[i].unresolved_pixels, alone.unresolved_pixels);
      double maximum = 0.0;
      for (std::size_t at = 0; at < alone.rgba.size(); ++at) {
        const double light = static_cast<double>(alone.rgba[at]);
        maximum = std::max(maximum, std::abs(static_cast<double>(eyes[i].rgba[at]) - light) / (light + 1e-2));
      }
      EXPECT_LT(maximum, 1e-4) << i << " " << convergence;
    }
  }
}

TEST(StereoModels, AreOneAtBaselineZero) {
  for (const char* projection : {"dome", "equirect"}) {
    ShowRenderer renderer(show_of_eyes("", std::string("projection = \"") + projection + "\"\nsize_px = 96\n"),
                          Backend::cpu);
    for (const StereoModel model : {StereoModel::physical, StereoModel::flat, StereoModel::omni}) {
      StereoSettings stereo = renderer.show().stereo;
      stereo.model = model;
      renderer.set_stereo(stereo);
      const auto eyes = renderer.render(0.0, {});
      ASSERT_EQ(eyes.size(), 2U);
      EXPECT_EQ(eyes[0].picture.rgba, eyes[1].picture.rgba) << static_cast<int>(model) << " " << projection;
    }
  }
}

TEST(StereoModels, SwapTheirPicturesWhenEyesAreSwapped) {
  ShowRenderer renderer(show_of_eyes("baseline = 0.5\ntint_eyes = true\n", "size_px = 64\n"), Backend::cpu);
  for (const StereoModel model : {StereoModel::physical, StereoModel::flat, StereoModel::omni}) {
    StereoSettings stereo = renderer.show().stereo;
    stereo.model = model;
    stereo.swap_eyes = false;
    renderer.set_stereo(stereo);
    const auto plain = renderer.render(0.0, {});
    stereo.swap_eyes = true;
    renderer.set_stereo(stereo);
    const auto swapped = renderer.render(0.0, {});
    EXPECT_EQ(plain[0].picture.rgba, swapped[1].picture.rgba) << static_cast<int>(model);
    EXPECT_EQ(plain[1].picture.rgba, swapped[0].picture.rgba) << static_cast<int>(model);
    EXPECT_NE(plain[0].picture.rgba, plain[1].picture.rgba) << static_cast<int>(model);
  }
}

Disparity disparity_of(const std::string& stereo, const std::string& position = "r = 9\n") {
  const Show show = show_of_eyes(stereo, "projection = \"pinhole\"\nfov_deg = 100\n", position);
  return frame_disparity(show, camera_pose(show, 0.0), make_projection(show.view, 400, 0.0), {}, {}).value();
}

TEST(Disparities, AreNoneAtBaselineZeroAndInTheSkyOfTheFlatModel) {
  for (const char* stereo : {"", "model = \"omni\"\n", "model = \"flat\"\nbaseline = 1\n"}) {
    const Disparity disparity = disparity_of(stereo);
    EXPECT_NEAR(disparity.min_px, 0.0, 1e-3) << stereo;
    EXPECT_NEAR(disparity.max_arcmin, 0.0, 1e-3) << stereo;
  }
}

TEST(Disparities, OfAFarShadowAreTheBaselineOverTheDistance) {
  const Disparity disparity = disparity_of("baseline = 2\n", "r = 1000\n");
  EXPECT_NEAR(disparity.min_arcmin, -60.0 * 180.0 / pi * 2.0 / 1000.0, 0.3);
}

TEST(Disparities, OfAShadowThatNoPictureShowsDoNotCount) {
  EXPECT_NEAR(disparity_of("baseline = 2\n", "r = 1000\nyaw_deg = 180\n").min_arcmin, 0.0, 0.1);
}

TEST(Disparities, OfConvergingEyesAreShiftedByTheirTurn) {
  const double apart = disparity_of("baseline = 2\n", "r = 1000\n").min_px;
  const Disparity turned = disparity_of("baseline = 2\nconvergence = 1000\n", "r = 1000\n");
  // Zero parallax is at the distance of the hole: points there have no disparity, and the sky is
  // behind them.
  EXPECT_LT(apart, -0.25);
  EXPECT_NEAR(turned.min_px, 0.0, 0.02);
  EXPECT_NEAR(turned.max_px, -apart, 0.04);
}

TEST(Disparities, OfTheSkyAreSteadyWhereSingleDirectionsComeNextToTheRing) {
  const Show show = parse_show(
      "[hole]\nspin = 0.7\n[camera]\nobserver = \"zamo\"\n[[camera.key]]\nr = 16\ntheta_deg = 84\n"
      "[view]\nprojection = \"pinhole\"\nfov_deg = 70\naspect = 1.6\n[stereo]\nlayout = \"separate\"\n"
      "baseline = 0.1\n",
      "steady.toml");
  std::vector<double> range_deg;
  for (int i = 0; i < 16; ++i) {
    CameraPose pose = camera_pose(show, 0.0);
    pose.r -= 0.05 * i;
    pose.theta += 0.001 * i;
    range_deg.push_back(frame_disparity(show, pose, make_projection(show.view, 1280, 0.0), {}, {}).value().range_deg());
  }
  const auto [minimum, maximum] = std::ranges::minmax(range_deg);
  EXPECT_LT(maximum, 1.3 * minimum);
}

TEST(Disparities, OfASkyThatIsBlackDoNotCount) {
  Show show = show_of_eyes("baseline = 1\n", "projection = \"pinhole\"\nfov_deg = 100\n");
  const auto counts = [&] {
    return frame_disparity(show, camera_pose(show, 0.0), make_projection(show.view, 400, 0.0), {}, {}).has_value();
  };
  show.sky.stars = "bright_stars";
  show.sky.map = "black";
  EXPECT_TRUE(counts());
  show.sky.stars.clear();
  EXPECT_FALSE(counts());
}

TEST(Convergence, PutsThingsAtItsDistanceInOnePlace) {
  const Projection screen = make_pinhole_projection(100, 100, 1.0);
  const Projection dome = make_dome_projection(100, pi, 0.3);
  const auto pixel_of = [](const Projection& projection, const Vector3<double>& thing, double offset, double* xy) {
    const Projection own = converged_projection(projection, offset, 8.0);
    const Vector3<double> way = thing - Vector3<double>{offset, 0.0, 0.0};
    ASSERT_TRUE(pixel_from_direction(own, test::unit_of(way), xy[0], xy[1]));
  };
  for (const double offset : {-0.5, 0.5, 2.0}) {
    double on_screen[4];
    pixel_of(screen, {1.0, 0.7, -8.0}, 0.0, on_screen);
    pixel_of(screen, {1.0, 0.7, -8.0}, offset, on_screen + 2);
    EXPECT_NEAR(on_screen[0], on_screen[2], 1e-9);
    EXPECT_NEAR(on_screen[1], on_screen[3], 1e-9);
    const Vector3<double> on_sphere = 8.0 * test::unit_of({0.4, 0.5, -0.3});
    double on_dome[4];
    pixel_of(dome, on_sphere, 0.0, on_dome);
    pixel_of(dome, on_sphere, offset, on_dome + 2);
    EXPECT_NEAR(on_dome[0], on_dome[2], 1e-9);
    EXPECT_NEAR(on_dome[1], on_dome[3], 1e-9);
  }
  EXPECT_THROW(converged_projection(dome, 8.0, 8.0), Error);
}

TEST(StereoModels, RefuseWhatTheyCannotDraw) {
  Show show = show_of_eyes("model = \"omni\"\nbaseline = 0.1\n");
  show.sky.stars = "bright_stars";
  EXPECT_TRUE(missing_features(show).empty());
  show.stereo = {StereoLayout::rows, StereoModel::physical, 0.1, 5.0};
  show.view.projection = ViewProjection::equirect;
  EXPECT_FALSE(missing_features(show).empty());
}

}  // namespace
}  // namespace ergodome
