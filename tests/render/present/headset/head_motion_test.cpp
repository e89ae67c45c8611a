#include "render/present/headset/head_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "render/eyes/eye_camera.h"
#include "render/stereo/eye_distance.h"

namespace ergodome {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double unbounded = std::numeric_limits<double>::infinity();

Show show_at_radius(double r, const std::string& observer = "zamo", double spin = 0.9) {
  Show show = parse_show("[camera]\nobserver = \"" + observer +
                             "\"\n[[camera.key]]\nr = 20\ntheta_deg = 70\n"
                             "yaw_deg = 25\nroll_deg = 10\n",
                         "show.toml");
  show.spin = spin;
  show.camera.keys[0].r = r;
  return show;
}

double length_of(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

TEST(HeadMotion, HasAScaleWithComfortableDisparityAtAnyDistance) {
  constexpr double eye_distance_m = 0.064;
  for (const double r : {2.05, 2.2, 3.0, 10.0, 1e3, 1e5}) {
    const double scale = scale_per_meter({}, r, 2.0);
    EXPECT_GT(scale, 0.0) << r;
    if (r < 2.3) {
      continue;
    }
    const double disparity_deg = radian_deg * eye_distance_m * scale / (r - 2.0);
    EXPECT_LT(disparity_deg, 0.5) << r;
    EXPECT_GT(disparity_deg, 0.1) << r << ": depth is visible";
    Show show = show_at_radius(r, "zamo", 0.0);
    for (const StereoModel model : {StereoModel::flat, StereoModel::omni}) {
      show.stereo.model = model;
      EXPECT_LT(eye_distance_m * scale, 0.1 * max_baseline(show, camera_pose(show, 0.0))) << r;
    }
  }
}

TEST(HeadMotion, TakesTheScaleOfTheShow) {
  HeadsetSettings settings;
  settings.scale = 0.3;
  EXPECT_EQ(scale_per_meter(settings, 10.0, 2.0), 0.3);
  EXPECT_EQ(scale_per_meter(settings, no_number, 2.0), 0.3);
  EXPECT_NEAR(scale_per_meter({}, 10.0, 2.0), 0.8, 1e-12);
  for (const double unusable : {-1.0, no_number, unbounded}) {
    settings.scale = unusable;
    EXPECT_NEAR(scale_per_meter(settings, 10.0, 2.0), 0.8, 1e-12);
  }
  EXPECT_NEAR(scale_per_meter({}, 1.5, 2.0), 0.015, 1e-12) << "inside the horizon";
  EXPECT_EQ(scale_per_meter({}, no_number, 2.0), 0.0);
  EXPECT_EQ(scale_per_meter({}, unbounded, 2.0), 0.0);
  EXPECT_EQ(scale_per_meter({}, 10.0, no_number), 0.0);
  EXPECT_EQ(scale_per_meter({}, -1.0, 2.0), 0.0);
}

TEST(HeadMotion, ShortensLongOffsetsAndKeepsTheirDirection) {
  const Vector3<double> kept = limited_head_offset({0.3, -0.4, 0.0}, 1.0);
  EXPECT_EQ(kept.x, 0.3);
  EXPECT_EQ(kept.y, -0.4);
  const Vector3<double> shortened = limited_head_offset({3.0, -4.0, 12.0}, 2.6);
  EXPECT_NEAR(shortened.x, 0.6, 1e-12);
  EXPECT_NEAR(shortened.y, -0.8, 1e-12);
  EXPECT_NEAR(shortened.z, 2.4, 1e-12);
  for (const double any : {no_number, unbounded, -unbounded, 1e308}) {
    for (const double maximum : {0.0, 2.0, -1.0, no_number}) {
      const Vector3<double> v = limited_head_offset({any, any, 1.0}, maximum);
      EXPECT_LE(length_of(v), (maximum > 0.0 ? maximum : 0.0) + 1e-12);
    }
  }
}

TEST(HeadMotion, MovesTheHeadToWhereAnEyeWouldBe) {
  const Vector3<double> offset = {0.4, -0.2, 0.7};
  for (const char* const observer : {"zamo", "rain", "static", "geodesic"}) {
    const Show show = show_at_radius(8.0, observer);
    const CameraPose pose = camera_pose(show, 0.0);
    const CameraPose moved = moved_head(show, pose, offset);
    const EyeCamera eye = eye_camera(show, pose, offset);
    const EyeCamera head = eye_camera(show, moved, 0.0);
    EXPECT_GT(std::abs(moved.r - pose.r), 0.1);
    EXPECT_NEAR(head.r, eye.r, 1e-12) << observer;
    EXPECT_NEAR(head.theta, eye.theta, 1e-12) << observer;
    EXPECT_NEAR(head.phi, eye.phi, 1e-12) << observer;
    EXPECT_EQ(head.motion, eye.motion) << observer;
    EXPECT_NEAR(length_of(head.velocity - eye.velocity), 0.0, 1e-12) << observer;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(head.frame_from_view[i][j], eye.frame_from_view[i][j], 1e-12) << observer;
      }
    }
    const CameraPose still = moved_head(show, pose, {0.0, 0.0, 0.0});
    EXPECT_EQ(still.r, pose.r);
    EXPECT_EQ(still.theta, pose.theta);
  }
}

TEST(HeadMotion, KeepsTheHeadOutsideTheHorizon) {
  for (const double r : {1.5, 2.0, 4.0, 30.0}) {
    const Show show = show_at_radius(r);
    const CameraPose pose = camera_pose(show, 0.0);
    EXPECT_GT(max_head_offset(spacetime_of(show), pose), 0.1 * (r - horizon_radius(spacetime_of(show)))) << r;
    for (const Vector3<double>& offset : {Vector3<double>{0.0, 0.0, -1e6},
                                          {0.0, 0.0, -unbounded},
                                          {unbounded, 1.0, -unbounded},
                                          {no_number, 0.0, -1e9}}) {
      const CameraPose moved = moved_head(show, pose, offset);
      EXPECT_GT(moved.r, horizon_radius(spacetime_of(show))) << r;
      EXPECT_TRUE(std::isfinite(moved.r + moved.theta + moved.phi)) << r;
      EXPECT_NO_THROW(eye_camera(show, moved, 0.0)) << r;
    }
  }
}

TEST(HeadMotion, IsPossibleInAFallThroughTheHorizon) {
  const Show show = show_at_radius(8.0);
  CameraPose pose = camera_pose(show, 0.0);
  pose.velocity = Vector3<double>{0.0, 0.0, 0.0};
  pose.velocity_in_rain = true;
  for (const double r : {1.0, 1.4, 1.7, 3.0}) {
    pose.r = r;
    pose.clock_lead = 0.25;
    const Vector3<double> offset = {0.0, 0.02, -0.01};
    const CameraPose moved = moved_head(show, pose, offset);
    const EyeCamera eye = eye_camera(show, pose, offset);
    const EyeCamera head = eye_camera(show, moved, 0.0);
    EXPECT_TRUE(moved.velocity_in_rain);
    EXPECT_EQ(head.motion, ObserverMotion::rain_boost);
    EXPECT_NEAR(head.r, eye.r, 1e-12) << r;
    EXPECT_NEAR(head.clock_lead, eye.clock_lead, 1e-12) << r;
    EXPECT_GT(moved_head(show, pose, {0.0, 0.0, -1e6}).r, min_interior_radius(spacetime_of(show))) << r;
  }
}

}  // namespace
}  // namespace ergodome
