#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/geodesic/affine_distance.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "kernels/spacetime/shadow/pixel_coverage.h"
#include "render/frame/show_renderer.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/passes/flat_shadow/shadow_mask.h"
#include "tests/render/stereo_scene.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): shows of tests

//! Returns whether an eye at the position `eye` sees the horizon in direction `m`. This is the case
//! if a point on its line of sight is in a dark direction of the head and at least as far away as
//! the affine distance of the horizon in that direction.
bool meets_horizon(const CameraStation& camera, const Vector3<double>& m, const Vector3<double>& eye) {
  for (int i = 0; i < 3000; ++i) {
    const double s = 0.05 * std::pow(1.004, i);
    const Vector3<double> position = eye + s * m;
    const double distance = std::sqrt(dot(position, position));
    const Vector3<double> n = (1.0 / distance) * position;
    if (!direction_is_bright(camera, n) && distance >= affine_distance(camera, n, camera.horizon_r)) {
      return true;
    }
  }
  return false;
}

TEST(FlatEyes, SeeTheShadowWhereFlatSpacePutsTheHorizon) {
  const Show show = show_of_eyes("model = \"flat\"\n");
  const EyeCamera head = eye_camera(show, camera_pose(show, 0.0), 0.0);
  const CameraStation camera = make_camera_station(head.spacetime, head.r, head.theta, 0.0, head.motion, head.velocity);
  const FlatShadow shadow(head);
  constexpr double offset = 0.5;
  const std::vector<float> edge = shadow.eye_edge(offset);
  const Vector3<double> right = {head.frame_from_view[0][0], head.frame_from_view[1][0], head.frame_from_view[2][0]};
  const ShadowChart chart = make_shadow_chart(camera);
  // A tenth of a pixel of a 1024² dome [rad].
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
  const Show show = show_of_eyes("model = \"flat\"\nbaseline = 1\n");
  const auto eyes = ShowRenderer(show, Backend::cpu).render(0.0, {});
  const Projection projection = make_projection(show.view, 400, 0.0);
  const EyeCamera head = eye_camera(show, camera_pose(show, 0.0), 0.0);
  const CameraStation camera = make_camera_station(head.spacetime, head.r, head.theta, 0.0, head.motion, head.velocity);
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
        // The edge may be in the next pixel, so the darkest of 3 x 3 pixels counts.
        float darkest = 1.0F;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            darkest = std::min(darkest, coverage_at(eyes[static_cast<std::size_t>(eye)].picture,
                                                    static_cast<int>(x) + dx, static_cast<int>(y) + dy));
          }
        }
        EXPECT_LT(darkest, 0.99F) << gamma << " " << part << " " << eye;
      }
    }
  }
}

TEST(FlatEyes, HaveTheSkyWhereTheHeadHasIt) {
  ShowRenderer renderer(show_of_eyes("model = \"flat\"\nbaseline = 1\n"), Backend::cpu);
  const auto eyes = renderer.render(0.0, {});
  StereoSettings stereo = renderer.show().stereo;
  stereo.baseline = 0.0;
  renderer.set_stereo(stereo);
  const auto head = renderer.render(0.0, {});
  long different = 0;
  for (std::size_t i = 0; i < head[0].picture.rgba.size(); i += 4) {
    for (const auto& eye : eyes) {
      // A pixel of an eye either has the light of the head's pixel, or all of its channels are
      // reduced by the same factor.
      const float lit = eye.picture.rgba[i + 3];
      const float before = head[0].picture.rgba[i + 3];
      EXPECT_LE(lit, before);
      EXPECT_NEAR(eye.picture.rgba[i] * before, head[0].picture.rgba[i] * lit, 1e-5F);
      different += lit < before ? 1 : 0;
    }
  }
  EXPECT_GT(different, 200);
}

//! Masks a white picture for the eye at `offset` and compares each pixel with the ratio of the
//! coverages. Returns the number of pixels that are darkened, and adds those without light to `dark`.
int compare_mask(const FlatShadow& shadow, double offset, const Projection& projection, int& dark) {
  const std::vector<float> edge = shadow.eye_edge(offset);
  const EdgeCurve head = edge_view(shadow.chart(), shadow.head_edge());
  const EdgeCurve eye = edge_view(shadow.chart(), edge);
  const ProjectionOf<float> narrowed = converted_projection<float>(projection);
  Picture picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  picture.rgba.assign(4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 1.0F);
  mask_shadow(picture, projection, head, eye);
  int darker = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      using D = Dual<float>;
      const Vector3<D> view = direction_from_pixel(narrowed, D(static_cast<float>(x) + 0.5F, 1.0F, 0.0F),
                                                   D(static_cast<float>(y) + 0.5F, 0.0F, 1.0F));
      const auto lit = [&](const EdgeCurve& curve) {
        return cover_pixel(curve, Vector3<float>{view.x.value, view.y.value, view.z.value},
                           Vector3<float>{view.x.along_x, view.y.along_x, view.z.along_x},
                           Vector3<float>{view.x.along_y, view.y.along_y, view.z.along_y})
            .lit;
      };
      const float expected = lit(eye) < lit(head) ? lit(eye) / lit(head) : 1.0F;
      EXPECT_EQ(picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                  static_cast<std::size_t>(x))],
                expected)
          << static_cast<int>(projection.kind) << ": " << x << ", " << y;
      darker += expected < 1.0F ? 1 : 0;
      dark += expected == 0.0F ? 1 : 0;
    }
  }
  return darker;
}

TEST(FlatEyes, AreDarkenedPixelByPixelInEveryProjection) {
  const Show show = show_of_eyes("model = \"flat\"\n");
  const FlatShadow shadow(eye_camera(show, camera_pose(show, 0.0), 0.0));
  for (const Projection& projection :
       {make_dome_projection(301, pi, 0.3), make_dome_projection(300, 2.0 * pi, 1.0),
        make_pinhole_projection(203, 150, 1.8), make_equirectangular_projection(330, 166),
        make_cube_projection(60, CubeLayout::cross)}) {
    int dark = 0;
    EXPECT_GT(compare_mask(shadow, 0.5, projection, dark), 20);
  }
}

TEST(FlatEyes, AreDarkenedInWideCrescentsAndBesideSmallShadows) {
  Show show = show_of_eyes("model = \"flat\"\n");
  const CameraPose pose = camera_pose(show, 0.0);
  int dark = 0;
  for (const double r : {pose.r, 60.0, 2000.0}) {
    CameraPose moved = pose;
    moved.r = r;
    const FlatShadow shadow(eye_camera(show, moved, 0.0));
    for (const double part : {-0.49, 0.4}) {
      for (const Projection& projection :
           {make_dome_projection(500, pi, 0.3), make_pinhole_projection(403, 300, 1.8)}) {
        compare_mask(shadow, part * shadow.max_baseline(), projection, dark);
      }
    }
  }
  // Whole squares of pixels between both edges lose their light.
  EXPECT_GT(dark, 2000);
}

TEST(FlatEyes, AreRefusedWhereTheHorizonIsBesideThem) {
  const Show show = show_of_eyes("model = \"flat\"\n");
  EXPECT_THROW(static_cast<void>(FlatShadow(eye_camera(show, camera_pose(show, 0.0), 0.0)).eye_edge(10.0)), Error);
}

}  // namespace
}  // namespace ergodome
