#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/schwarzschild/connecting_ray.h"
#include "render/frame/show_renderer.h"
#include "render/passes/objects/polygons/object_view.h"

// Compares pictures of a ball next to a hole without spin, for eyes of the stereo model `flat`,
// with the position of the ball by the closed form.
namespace ergodome::test {

//! A white ball in front of a black sky, and the camera and eyes that see it.
struct BallBeforeHead {
  const char* name;
  Vector3<double> position;  //!< position of the ball
  const char* observer = "static";
  const char* view = "projection = \"pinhole\"\nfov_deg = 100\nsize_px = 600\n";
  double baseline = 1.0;
  bool traced = false;
};

inline std::vector<BallBeforeHead> balls_before_heads() {
  return {
      {"beside the hole", {2, 6, 4}},
      {"behind the hole", {-8, 3, -2}},
      {"near", {10, 5.5, 4.2}},
      {"from a moving camera", {10, 5.5, 4.2}, "geodesic"},
      {"on a dome", {9, 9, 6}, "static", "projection = \"dome\"\nfov_deg = 220\nsize_px = 600\n"},
      {"in a cube", {9, 9, 6}, "static", "projection = \"cube\"\nsize_px = 1600\n"},
      {"from eyes far apart", {6, 6, 2}, "static", "projection = \"pinhole\"\nfov_deg = 100\nsize_px = 600\n", 3.0}};
}

inline Show flat_ball(const BallBeforeHead& at) {
  const auto number = [](double value) { return std::to_string(value); };
  return parse_show(
      "[hole]\nspin = 0\n[camera]\nobserver = \"" + std::string(at.observer) +
          "\"\n[[camera.key]]\nr = 15\ntheta_deg = 75\nphi_deg = 20\npitch_deg = 10\n[sky]\nmap = \"black\"\n"
          "[[objects]]\nshape = \"sphere\"\nsegments = 32\nrings = 16\nsize = 0.1\n" +
          (at.traced ? "method = \"trace\"\n" : "method = \"polygon\"\nimages = 2\ntessellation = { most = 4 }\n") +
          "position = [" + number(at.position.x) + ", " + number(at.position.y) + ", " + number(at.position.z) +
          "]\n[view]\n" + at.view +
          "[stereo]\nmodel = \"flat\"\nlayout = \"separate\"\nbaseline = " + number(at.baseline) + "\n",
      "flat.toml");
}

struct Middle {
  double x = 0.0;
  double y = 0.0;
  double light = 0.0;
};

//! Returns the center of the light within 30 pixels of a position.
inline Middle middle_about(double x_px, double y_px, const Picture& picture) {
  Middle middle;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto at =
          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
      const double value =
          std::hypot(x + 0.5 - x_px, y + 0.5 - y_px) < 30.0 ? static_cast<double>(picture.rgba[at]) : 0.0;
      middle.light += value;
      middle.x += (x + 0.5) * value;
      middle.y += (y + 0.5) * value;
    }
  }
  middle.x /= middle.light;
  middle.y /= middle.light;
  return middle;
}

//! The first image of the ball as the head sees it, by the closed form: its direction in the axes
//! of the view, and its affine distance.
struct SeenPosition {
  Vector3<double> view;
  double distance;
};

inline SeenPosition seen_position(const EyeCamera& head, const Vector3<double>& position) {
  const ObjectView axes = object_view(head);
  const Vector3<double> at = axes.in_frame(position);
  const double r = std::sqrt(dot(at, at));
  const double aside = std::hypot(at.y, at.z);
  const ConnectingRay ray = connecting_ray(head.r, r, std::atan2(aside, at.x));
  const Vector3<double> rest = {std::cos(ray.xi), std::sin(ray.xi) * at.y / aside, std::sin(ray.xi) * at.z / aside};
  // The energy of light is 1 at infinity and 1 / √(1 - 2/r) for an observer at rest at the camera's
  // radius. The motion of the camera then changes it.
  const FrameBoost boost =
      frame_boost(observer_velocity(head.motion, head.spacetime, head.r, head.theta, head.velocity));
  double energy = 1.0;
  const Vector3<double> n = aberrated(FrameBoost{boost.axis, 1.0 / boost.stretch}, rest, energy);
  return {in_view(head, n), ray.affine_distance / std::sqrt(1.0 - 2.0 / head.r) * energy};
}

//! Compares the position of a small ball in the pictures of both eyes with the position by the
//! closed form.
inline void expect_where_flat_space_puts(const BallBeforeHead& at) {
  SCOPED_TRACE(at.name);
  const Show show = flat_ball(at);
  const EyeCamera head = eye_camera(show, camera_pose(show, 0.0), 0.0);
  const Projection projection = make_projection(show.view, show.view.size_px, 0.0);
  const SeenPosition seen = seen_position(head, at.position);
  const auto find = [&](const Picture& picture, double offset) {
    const Vector3<double> view = seen_by_eye(seen.view, seen.distance, {offset, 0.0, 0.0});
    double x = 0.0;
    double y = 0.0;
    EXPECT_TRUE(pixel_from_direction(projection, view, x, y));
    const Middle middle = middle_about(x, y, picture);
    EXPECT_GT(middle.light, 1.0) << offset;
    return Middle{middle.x - x, middle.y - y, middle.light};
  };
  ShowRenderer renderer(show, Backend::cpu);
  const auto eyes = renderer.render_window_parts(camera_pose(show, 0.0), projection, ViewMode::sky);
  StereoSettings together = show.stereo;
  together.baseline = 0.0;
  renderer.set_stereo(together);
  const auto heads = renderer.render_window_parts(camera_pose(show, 0.0), projection, ViewMode::sky);
  // The center of the light differs from the center of the ball, because its image is distorted.
  // The difference is the same for both eyes and the head.
  const Middle none = find(heads[0], 0.0);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Middle off = find(eyes[eye], (eye == 0 ? -0.5 : 0.5) * at.baseline);
    EXPECT_NEAR(off.x, none.x, 0.1) << eye;
    EXPECT_NEAR(off.y, none.y, 0.1) << eye;
  }
  const auto apart = [&](double offset) {
    double x = 0.0;
    double y = 0.0;
    static_cast<void>(
        pixel_from_direction(projection, seen_by_eye(seen.view, seen.distance, {offset, 0.0, 0.0}), x, y));
    return x + y;
  };
  EXPECT_GT(std::abs(apart(-0.5 * at.baseline) - apart(0.5 * at.baseline)), 3.0);
}

}  // namespace ergodome::test
