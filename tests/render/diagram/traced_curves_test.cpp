#include "render/diagram/traced_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "render/diagram/light_curve.h"
#include "render/diagram/view_outline.h"
#include "render/lens/direct_lens.h"
#include "tests/render/diagram/point.h"

// Tests of rays that are traced backwards from a view around spinning holes.
namespace ergodome {
namespace {

using test::length_of;
using test::Point;

//! Returns a show with a ball and a camera on the x axis that faces the hole.
Show ball_show(double spin, const Point& position, double size) {
  Show show;
  show.name = "ball";
  show.spin = spin;
  show.camera.keys.resize(1);
  show.camera.keys[0].r = 30.0;
  show.view.projection = ViewProjection::pinhole;
  ObjectSettings ball;
  ball.form = ObjectForm::sphere;
  ball.method = ObjectMethod::trace;
  ball.position = position;
  ball.size = size;
  show.objects = {ball};
  return show;
}

EyeCamera eye_of(const Show& show) { return eye_camera(show, camera_pose(show, 0.0), 0.0); }

Projection coarse_view() { return make_pinhole_projection(64, 48, 50.0 * one_degree); }

TEST(TracedCurves, ThoseToObjectsBeginOnThemAndEndAtTheEye) {
  const Show show = ball_show(0.9, {-8.0, 3.0, 1.0}, 2.0);
  const EyeCamera eye = eye_of(show);
  const std::vector<TracedCurve> curves = traced_curves(eye, coarse_view(), ObjectRays(show, 0.0), {30, 5, 40.0});
  int meeting = 0;
  for (const TracedCurve& curve : curves) {
    ASSERT_GT(curve.positions.size(), 10U);
    EXPECT_LT(length_of(curve.positions.back() - position_of(eye)), 1e-9);
    if (curve.end == CurveEnd::object) {
      ++meeting;
      const double from_middle = length_of(curve.positions.front() - show.objects[0].position);
      EXPECT_LT(from_middle, 2.0 + 1e-6);
      EXPECT_GT(from_middle, 2.0 * std::cos(pi / 18.0));
    }
  }
  EXPECT_GE(meeting, 10);
}

TEST(TracedCurves, WithoutSpinTheyAreTheConnectingOrbits) {
  const Show show = ball_show(0.0, {-8.0, 3.0, 1.0}, 2.0);
  const EyeCamera eye = eye_of(show);
  int compared = 0;
  for (const TracedCurve& curve : traced_curves(eye, coarse_view(), ObjectRays(show, 0.0), {24, 5, 40.0})) {
    if (curve.end != CurveEnd::object) {
      continue;
    }
    ++compared;
    // Each point of the traced path must be on the orbit from the closed form. Its distance from
    // the nearest segment is at most the distance of a chord from its arc.
    const std::vector<Point> orbit = light_curve(position_of(eye), curve.positions.front(), curve.order);
    ASSERT_FALSE(orbit.empty());
    for (const Point& position : curve.positions) {
      double nearest = 1e9;
      for (std::size_t i = 1; i < orbit.size(); ++i) {
        nearest = std::min(nearest, distance_from_segment(position, orbit[i - 1], orbit[i]));
      }
      EXPECT_LT(nearest, 3e-3) << curve.order;
    }
  }
  EXPECT_GE(compared, 10);
}

TEST(TracedCurves, DirectAndSecondImagesAreToldByHalfTurns) {
  const Show show = ball_show(0.9, {-10.0, 0.5, 0.5}, 2.0);
  const std::vector<TracedCurve> curves = traced_curves(
      eye_of(show), make_pinhole_projection(160, 120, 50.0 * one_degree), ObjectRays(show, 0.0), {60, 5, 40.0});
  for (const int order : {1, 2}) {
    EXPECT_TRUE(std::ranges::any_of(curves, [&](const TracedCurve& curve) {
      return curve.end == CurveEnd::object && curve.order == order;
    })) << order;
  }
}

TEST(TracedCurves, OthersLeaveOrFallIntoTheHole) {
  const Show show = ball_show(0.9, {25.0, 6.0, 0.0}, 0.5);
  const EyeCamera eye = eye_of(show);
  const CameraStation camera = station_of(eye);
  const TracedCurve middle = traced_curve(camera, {-1.0, 0.0, 0.0}, MeshHit{}, 40.0);
  EXPECT_EQ(middle.end, CurveEnd::hole);
  EXPECT_LT(length_of(middle.positions.front()), 1.3 * camera.horizon_r);
  const TracedCurve beside = traced_curve(camera, {-0.8, 0.0, 0.6}, MeshHit{}, 40.0);
  EXPECT_EQ(beside.end, CurveEnd::sky);
  EXPECT_GT(length_of(beside.positions.front()), 30.0);
  EXPECT_LE(length_of(beside.positions.front()), 40.0);
}

}  // namespace
}  // namespace ergodome
