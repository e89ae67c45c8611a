#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "content/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/geodesic/affine_distance.h"
#include "kernels/projection/flat_parallax.h"
#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/shadow/critical_curve.h"
#include "render/frame/eye_disparity.h"
#include "render/frame/show_renderer.h"
#include "render/lens/flat_shadow.h"
#include "render/lens/omni_chooser.h"
#include "tests/render/omni_eyes.h"
#include "tests/support/sanitized.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

Show stereo_show(const std::string& stereo,
                 const std::string& view = "projection = \"pinhole\"\nfov_deg = 100\nsize_px = 400\n",
                 const std::string& place = "r = 9\ntheta_deg = 70\n") {
  Show show = parse_show("[hole]\nspin = 0.95\n[camera]\n[[camera.key]]\n" + place + "[view]\n" + view +
                             "[stereo]\nlayout = \"separate\"\n" + stereo,
                         "stereo.toml");
  show.sky.map = test::tiny_sky();
  return show;
}

float coverage(const Picture& picture, int x, int y) {
  return picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + 3];
}

//! Where the shadow's left side crosses the middle of a row, by the light to the left of it [px].
double left_side(const Picture& picture, int row) {
  double sum = 0.0;
  for (int x = 0; x < picture.width / 2; ++x) {
    sum += static_cast<double>(coverage(picture, x, row));
  }
  return sum;
}

//! The same from the critical curve of a camera at the eye's event.
double left_side_of_curve(const EyeCamera& eye, const Projection& projection, int row) {
  const CameraStation camera = make_camera_station(eye.spin, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
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
    ShowRenderer renderer(stereo_show(""), Backend::cpu, lens);
    for (const double baseline :
         test::sanitized ? std::vector<double>{1e-2, 1.0} : std::vector<double>{1e-4, 1e-3, 1e-2, 0.1, 1.0}) {
      expect_disparity_of_direct_cameras(renderer, baseline);
    }
  }
}

TEST(StereoModels, AreOneAtBaselineZero) {
  for (const char* projection : {"dome", "equirect"}) {
    ShowRenderer renderer(stereo_show("", std::string("projection = \"") + projection + "\"\nsize_px = 96\n"),
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
  ShowRenderer renderer(stereo_show("baseline = 0.5\ntint_eyes = true\n", "size_px = 64\n"), Backend::cpu);
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

//! Whether an eye at `eye` sees the horizon in direction `m`: whether its line of sight, walked along, passes a dark direction of the head's
//! beyond that direction's affine distance.
bool meets_horizon(const CameraStation& camera, const Vector3<double>& m, const Vector3<double>& eye) {
  for (int i = 0; i < 3000; ++i) {
    const double s = 0.05 * std::pow(1.004, i);
    const Vector3<double> place = eye + s * m;
    const double distance = std::sqrt(dot(place, place));
    const Vector3<double> n = (1.0 / distance) * place;
    if (!direction_is_bright(camera, n) && distance >= affine_distance(camera, n, camera.horizon_r)) {
      return true;
    }
  }
  return false;
}

TEST(FlatEyes, SeeTheShadowWhereFlatSpacePutsTheHorizon) {
  const Show show = stereo_show("model = \"flat\"\n");
  const EyeCamera head = eye_camera(show, camera_pose(show, 0.0), 0.0);
  const CameraStation camera = make_camera_station(head.spin, head.r, head.theta, 0.0, head.motion, head.velocity);
  const FlatShadow shadow(head);
  constexpr double offset = 0.5;
  const std::vector<float> edge = shadow.eye_edge(offset);
  const Vector3<double> right = {head.frame_from_view[0][0], head.frame_from_view[1][0], head.frame_from_view[2][0]};
  const ShadowChart chart = make_shadow_chart(camera);
  // A tenth of a pixel of a 1k dome.
  constexpr double tenth = 3e-4;
  int moved = 0;
  for (std::size_t i = 0; i < edge.size(); i += edge.size() / 12) {
    const double gamma = 2.0 * pi * static_cast<double>(i) / static_cast<double>(edge.size());
    const auto sees = [&](double alpha) {
      return meets_horizon(camera, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma),
                           offset * right);
    };
    if (edge[i] > shadow.head_edge()[i] + 1e-3F) {
      ++moved;
      EXPECT_TRUE(sees(static_cast<double>(edge[i]) - tenth)) << gamma;
    }
    EXPECT_FALSE(sees(static_cast<double>(edge[i]) + tenth)) << gamma;
  }
  EXPECT_GE(moved, 4);
}

TEST(FlatEyes, HaveTheirDarkDirectionsWhereTheAffineDistancePutsThem) {
  const Show show = stereo_show("model = \"flat\"\nbaseline = 1\n");
  const auto eyes = ShowRenderer(show, Backend::cpu).render(0.0, {});
  const Projection projection = make_projection(show.view, 400, 0.0);
  const EyeCamera head = eye_camera(show, camera_pose(show, 0.0), 0.0);
  const CameraStation camera = make_camera_station(head.spin, head.r, head.theta, 0.0, head.motion, head.velocity);
  const ShadowChart chart = make_shadow_chart(camera);
  for (int i = 0; i < 60; ++i) {
    const double gamma = 2.0 * pi * i / 60;
    for (const double part : {0.999, 0.99, 0.9, 0.5}) {
      const double alpha = part * edge_polar_angle(camera, chart, gamma);
      const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
      const double distance = affine_distance(camera, n, camera.horizon_r);
      for (const int eye : {0, 1}) {
        const Vector3<double> seen = seen_by_eye(in_view(head, n), distance, {eye == 0 ? -0.5 : 0.5, 0.0, 0.0});
        double x = 0.0;
        double y = 0.0;
        ASSERT_TRUE(pixel_from_direction(projection, seen, x, y));
        // The edge may be next to it.
        float darkest = 1.0F;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            darkest = std::min(darkest, coverage(eyes[static_cast<std::size_t>(eye)].picture, static_cast<int>(x) + dx,
                                                 static_cast<int>(y) + dy));
          }
        }
        EXPECT_LT(darkest, 0.99F) << gamma << " " << part << " " << eye;
      }
    }
  }
}

TEST(FlatEyes, HaveTheSkyWhereTheHeadHasIt) {
  ShowRenderer renderer(stereo_show("model = \"flat\"\nbaseline = 1\n"), Backend::cpu);
  const auto eyes = renderer.render(0.0, {});
  StereoSettings stereo = renderer.show().stereo;
  stereo.baseline = 0.0;
  renderer.set_stereo(stereo);
  const auto head = renderer.render(0.0, {});
  long different = 0;
  for (std::size_t i = 0; i < head[0].picture.rgba.size(); i += 4) {
    for (const auto& eye : eyes) {
      // Either the head's light, or less of all its parts by one factor.
      const float lit = eye.picture.rgba[i + 3];
      const float before = head[0].picture.rgba[i + 3];
      EXPECT_LE(lit, before);
      EXPECT_NEAR(eye.picture.rgba[i] * before, head[0].picture.rgba[i] * lit, 1e-5F);
      different += lit < before ? 1 : 0;
    }
  }
  EXPECT_GT(different, 200);
}

TEST(FlatEyes, AreRefusedWhereTheHorizonIsBesideThem) {
  const Show show = stereo_show("model = \"flat\"\n");
  EXPECT_THROW(static_cast<void>(FlatShadow(eye_camera(show, camera_pose(show, 0.0), 0.0)).eye_edge(10.0)), Error);
}

struct OmniErrors {
  double largest_px = 0.0;
  int compared = 0;
  int beyond = 0;  //!< a fifth of a pixel
  int wrong = 0;   //!< shadow where there is sky, or the other way round
};

OmniErrors omni_errors(const Show& show, double half_baseline, double side, const Projection& projection,
                       double convergence, LensChoice choice) {
  const CameraPose pose = camera_pose(show, 0.0);
  const EyePlace eye_at = [&](const Vector3<double>& offset) { return eye_camera(show, pose, offset); };
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
    const auto [camera, n] = test::own_ray(eye_at, view, side * half_baseline, convergence);
    const bool bright = direction_is_bright(camera, n);
    const float covered = out.coverage[at];
    if (covered > 0.0F && covered < 1.0F) {
      continue;  // on the edge, which has a place of its own to look at
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
    // Next to a caustic, where the sky moves a twentieth of what the screen does, rays do not tell where on it light is.
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
      // A grid is checked in places: between them, next to the edge, few pixels are off by more.
      const int may_be = choice == LensChoice::live ? 1 + errors.compared / 1000 : 0;
      EXPECT_LE(errors.beyond, may_be) << half_baseline << " " << side;
      EXPECT_LT(errors.largest_px, may_be > 0 ? 1.0 : 0.2) << half_baseline << " " << side;
      EXPECT_EQ(errors.wrong, 0) << half_baseline << " " << side;
      EXPECT_GT(errors.compared, 100);
    }
  }
}

TEST(OmniEyes, AgreeWithDirectRaysFromEachPixelsOwnCamera) {
  const Show show = stereo_show("model = \"omni\"\n");
  for (const double half : {5e-5, 0.05, 0.5}) {
    expect_omni(show, half, make_dome_projection(256, pi, 0.4));
  }
  if (!test::sanitized) {
    // As large as pictures are that are read from grids of themselves.
    expect_omni(show, 0.5, make_dome_projection(512, pi, 0.4), 0.0, {LensChoice::live});
  }
  expect_omni(show, 0.5, make_equirectangular_projection(256, 128));
  expect_omni(show, 0.5, make_cylinder_projection(256, 82, 2.0 * pi, -1.0, 1.0));
  expect_omni(show, 0.5, make_cube_projection(64, CubeLayout::strip));
}

TEST(OmniEyes, AgreeForEyesThatConverge) {
  expect_omni(stereo_show("model = \"omni\"\n"), 0.5, make_dome_projection(256, pi, 0.4), 12.0);
}

TEST(OmniEyes, AgreeFarApart) {
  expect_omni(stereo_show("model = \"omni\"\n", "", "r = 30\ntheta_deg = 70\n"), 4.0,
              make_dome_projection(256, pi, 0.4));
}

TEST(OmniEyes, AgreeOnTheSpinAxis) {
  expect_omni(stereo_show("model = \"omni\"\n", "", "r = 9\ntheta_deg = 0\n"), 0.2, make_dome_projection(256, pi, 0.4));
}

TEST(OmniEyes, AreRefusedWhereNoCamerasLie) {
  const Show show = stereo_show("model = \"omni\"\n");
  const EyePlace eye_at = [&](const Vector3<double>& offset) {
    return eye_camera(show, camera_pose(show, 0.0), offset);
  };
  EXPECT_THROW(OmniCamera(Backend::cpu, eye_at, {20.0}), Error);
}

Disparity disparity_of(const std::string& stereo, const std::string& place = "r = 9\n") {
  const Show show = stereo_show(stereo, "projection = \"pinhole\"\nfov_deg = 100\n", place);
  return frame_disparity(show, camera_pose(show, 0.0), make_projection(show.view, 400, 0.0)).value();
}

TEST(Disparities, AreNoneAtBaselineZeroAndInTheSkyOfTheFlatModel) {
  for (const char* stereo : {"", "model = \"omni\"\n", "model = \"flat\"\nbaseline = 1\n"}) {
    const Disparity disparity = disparity_of(stereo);
    EXPECT_NEAR(disparity.least_px, 0.0, 1e-3) << stereo;
    EXPECT_NEAR(disparity.greatest_arcmin, 0.0, 1e-3) << stereo;
  }
}

TEST(Disparities, OfAFarShadowAreTheBaselineOverTheDistance) {
  const Disparity disparity = disparity_of("baseline = 2\n", "r = 1000\n");
  EXPECT_NEAR(disparity.least_arcmin, -60.0 * 180.0 / pi * 2.0 / 1000.0, 0.3);
}

TEST(Disparities, OfConvergingEyesAreShiftedByTheirTurn) {
  const double apart = disparity_of("baseline = 2\n", "r = 1000\n").least_px;
  const Disparity turned = disparity_of("baseline = 2\nconvergence = 1000\n", "r = 1000\n");
  // The plane is at the hole: what is there has none left, and the sky is behind it.
  EXPECT_LT(apart, -0.25);
  EXPECT_NEAR(turned.least_px, 0.0, 0.02);
  EXPECT_NEAR(turned.greatest_px, -apart, 0.04);
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
  Show show = stereo_show("model = \"omni\"\nbaseline = 0.1\n");
  show.sky.stars = "bright_stars";
  EXPECT_TRUE(missing_features(show).empty());
  show.sky.star_method = StarMethod::gather;
  EXPECT_FALSE(missing_features(show).empty());
  show.sky.stars.clear();
  EXPECT_TRUE(missing_features(show).empty());
  show.stereo = {StereoLayout::rows, StereoModel::physical, 0.1, 5.0};
  show.view.projection = ViewProjection::equirect;
  EXPECT_FALSE(missing_features(show).empty());
}

}  // namespace
}  // namespace ergodome
