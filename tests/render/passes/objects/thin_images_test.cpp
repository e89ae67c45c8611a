#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/frame/show_renderer.h"
#include "render/passes/objects/object_rays.h"
#include "tests/render/eye_at.h"
#include "tests/render/passes/objects/traced_scene.h"

// Tests of lensed images of objects next to the edge of the shadow, which are a few hundredths of a
// pixel thin.
namespace ergodome {
namespace {

using test::ball;
using test::draw;
using test::Drawn;
using test::eye_at;
using test::observed;
using test::show_of;
using test::station;

//! A ball next to the hole. Its third image is closer to the shadow's edge than a hundredth of the
//! shadow's radius; its second image is farther from the edge than `thin_part` of this radius.
class ThinImages : public testing::TestWithParam<double> {
 protected:
  static constexpr double thin_part = 0.022;

  [[nodiscard]] static Show show() { return show_of(GetParam(), {ball({2.0, 9.0, 1.0}, 1.5)}); }
  [[nodiscard]] static EyeCamera eye(double r) { return eye_at(GetParam(), r, 1.45); }
  [[nodiscard]] static Projection projection() { return make_pinhole_projection(128, 128, 0.45); }

  //! Returns the solid angle [sr] that the ball covers in a picture, but only in pixels outside the
  //! shadow's edge and within `thin_part` of the shadow's radius from it. covered(x, y) returns the
  //! fraction of a pixel that objects cover.
  template <class Covered>
  [[nodiscard]] static double solid_angle(double r, const Projection& projection, const Covered& covered) {
    const CameraStation camera = station(eye(r));
    const ShadowChart chart = make_shadow_chart(camera);
    double sum = 0.0;
    for (int y = 0; y < projection.height_px; ++y) {
      for (int x = 0; x < projection.width_px; ++x) {
        const Vector3<double> n = observed(eye(r), projection, x + 0.5, y + 0.5);
        const double edge = edge_polar_angle(camera, chart, chart_position_angle(chart, n));
        if (covered(x, y) > 0.0F && chart_polar_angle(chart, n) < (1.0 + thin_part) * edge) {
          sum += static_cast<double>(covered(x, y)) * pixel_solid_angle(projection, x + 0.5, y + 0.5);
        }
      }
    }
    return sum;
  }

  [[nodiscard]] static double drawn_solid_angle(double r) {
    const Drawn drawn = draw(show(), eye(r), projection());
    return solid_angle(r, drawn.projection, [&](int x, int y) { return drawn.covered(x, y); });
  }

  //! Returns solid_angle() of the ball for the picture of one eye of the stereo model `flat`, with
  //! the given baseline [M].
  [[nodiscard]] static double solid_angle_of_flat_eye(double r, double baseline) {
    Show eyes = parse_show(
        "[hole]\nspin = " + std::to_string(GetParam()) +
            "\n[camera]\n[[camera.key]]\nr = 30\n[sky]\nmap = \"black\"\n" +
            "[stereo]\nmodel = \"flat\"\nlayout = \"separate\"\nbaseline = " + std::to_string(baseline) + "\n",
        "thin.toml");
    eyes.objects = show().objects;
    CameraPose pose = camera_pose(eyes, 0.0);
    pose.r = r;
    pose.theta = eye(r).theta;
    ShowRenderer renderer(eyes, Backend::cpu, LensChoice::direct);
    const Picture left = renderer.render_window_parts(pose, projection(), ViewMode::sky).front();
    return solid_angle(r, projection(),
                       [&](int x, int y) { return left.rgba[4UL * static_cast<std::size_t>(y * left.width + x)]; });
  }

  //! Returns the solid angle [sr] that the ball covers outside the shadow's edge and within
  //! `thin_part` of the shadow's radius from it, by exact rays. Their directions are on a Fibonacci
  //! lattice over the position angle and the logarithm of the distance from the edge.
  [[nodiscard]] static double exact_solid_angle(double r) {
    constexpr int count = test::sanitized ? 1597 : 10946;
    constexpr int step = test::sanitized ? 987 : 6765;
    constexpr double powers = 5.0;  // range of ln(distance from the shadow's edge)
    const CameraStation camera = station(eye(r));
    const ShadowChart chart = make_shadow_chart(camera);
    const ObjectRays rays(show(), 0.0);
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
      const double gamma = 2.0 * pi * (i + 0.5) / count;
      const double edge = edge_polar_angle(camera, chart, gamma);
      const double inwards = (static_cast<double>(static_cast<long>(i) * step % count) + 0.5) / count;
      const double outside = thin_part * edge * std::exp(-powers * inwards);
      const double alpha = edge + outside;
      const auto hit =
          rays.first_hit(camera, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma), 1e-8);
      sum += hit && hit->mesh >= 0 ? outside * std::sin(alpha) : 0.0;
    }
    return sum * powers * 2.0 * pi / count;
  }
};

TEST_P(ThinImages, HaveAsMuchLightAsExactRaysFind) {
  const double exact = exact_solid_angle(30.0);
  EXPECT_GT(exact, 0.0);
  EXPECT_NEAR(drawn_solid_angle(30.0), exact, (test::sanitized ? 0.2 : 0.07) * exact);
}

TEST_P(ThinImages, KeepTheirLightAsTheCameraMovesByPartsOfAPixel) {
  // Compares solid angles relative to that of the shadow. From one camera to the next, the edge of
  // the shadow moves by a tenth of a pixel.
  std::vector<double> shares;
  double mean = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double r = 30.0 + 0.07 * i;
    shares.push_back(r * r * drawn_solid_angle(r));
    mean += shares.back() / 3.0;
  }
  for (const double share : shares) {
    EXPECT_NEAR(share, mean, 0.04 * mean);
  }
}

TEST_P(ThinImages, LeaveThePlacesOfRaysFarFromTheEdgeAsTheyAre) {
  const Drawn drawn = draw(show(), eye(30.0), make_pinhole_projection(64, 64, 0.9));
  const CameraStation camera = station(eye(30.0));
  const ShadowChart chart = make_shadow_chart(camera);
  int partly = 0;
  for (int y = 0; y < drawn.projection.height_px; ++y) {
    for (int x = 0; x < drawn.projection.width_px; ++x) {
      const Vector3<double> n = observed(eye(30.0), drawn.projection, x + 0.5, y + 0.5);
      if (chart_polar_angle(chart, n) > 1.5 * edge_polar_angle(camera, chart, chart_position_angle(chart, n))) {
        const float sixteenths = 16.0F * drawn.covered(x, y);
        EXPECT_EQ(sixteenths, std::round(sixteenths)) << x << ", " << y;
        partly += sixteenths > 0.0F && sixteenths < 16.0F ? 1 : 0;
      }
    }
  }
  EXPECT_GT(partly, 10);
}

//! Tests that eyes with a small baseline see the same as the head.
class ThinImagesOfFlatEyes : public ThinImages {};

TEST_P(ThinImagesOfFlatEyes, HaveAsMuchLightAsExactRaysFind) {
  const double exact = exact_solid_angle(30.0);
  EXPECT_NEAR(solid_angle_of_flat_eye(30.0, 1e-3), exact, (test::sanitized ? 0.2 : 0.07) * exact);
}

INSTANTIATE_TEST_SUITE_P(Spins, ThinImages, testing::Values(0.0, 0.9));
INSTANTIATE_TEST_SUITE_P(Spins, ThinImagesOfFlatEyes, testing::Values(0.9));

}  // namespace
}  // namespace ergodome
