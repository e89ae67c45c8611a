#include "render/stereo/eye_disparity.h"

#include <cmath>
#include <span>
#include <vector>

#include "content/show/stereo_eyes.h"
#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/stereo/near_disparity.h"

namespace ergodome {

namespace {

using EdgeDual = Dual<double>;

constexpr int order = 14;
constexpr int max_rounds = 12;
constexpr double found = 1e-7;
//! Maximum angle between the images of a star in the two eyes [rad]. A larger angle means that they
//! are different lensed images.
constexpr double farthest = 0.5;

//! Computes the sky direction that an eye sees in a view direction, with its derivatives along two
//! directions of the view. Returns false in the shadow, or if the ray does not converge.
bool sky_seen_by(const StereoEye& from, const Vector3<EdgeDual>& seen, Vector3<EdgeDual>& sky) {
  const Vector3<double> middle = {seen.x.value, seen.y.value, seen.z.value};
  const EyeCamera eye = from.camera(middle);
  const Vector3<double> turn = from.convergence_turn(middle);
  const Vector3<EdgeDual> turned = {seen.x - turn.x, seen.y - turn.y, seen.z - turn.z};
  const EdgeDual inverse_length = 1.0 / sqrt(dot(turned, turned));
  const Vector3<EdgeDual> view = {turned.x * inverse_length, turned.y * inverse_length, turned.z * inverse_length};
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  const auto row = [&](int i) {
    const double(&m)[3] = eye.frame_from_view[i];
    return view.x * m[0] + view.y * m[1] + view.z * m[2];
  };
  const RayStart<EdgeDual> start = start_ray<EdgeDual>(camera, {row(0), row(1), row(2)});
  if (!comes_from_sky(camera.spin, camera.horizon_r, plain_start(start))) {
    return false;
  }
  double steps = 0.0;
  bool reached = false;
  const RayEnd<EdgeDual> end = trace_taylor<order>(camera.spin, start, true, {1e-9, 400, true}, steps, reached);
  sky = turned_to_camera<EdgeDual>(camera, end.sky);
  return reached;
}

Vector3<double> values(const Vector3<EdgeDual>& v) { return {v.x.value, v.y.value, v.z.value}; }

//! Finds the view direction in which an eye sees a point of the sky, by Newton's method from the
//! initial guess in `view`. Returns false if the method does not converge within 0.5 rad of it.
bool find_direction(const StereoEye& eye, const Vector3<double>& star, Vector3<double>& view) {
  const Vector3<double> first = view;
  for (int round = 0; round < max_rounds; ++round) {
    const Vector3<double> across =
        normalized(cross(std::abs(view.y) < 0.9 ? Vector3<double>{0, 1, 0} : Vector3<double>{1, 0, 0}, view));
    const Vector3<double> up = cross(view, across);
    Vector3<EdgeDual> sky{};
    if (!sky_seen_by(
            eye, {EdgeDual(view.x, across.x, up.x), EdgeDual(view.y, across.y, up.y), EdgeDual(view.z, across.z, up.z)},
            sky)) {
      return false;
    }
    const Vector3<double> missing = star - values(sky);
    const Vector3<double> j1 = {sky.x.along_x, sky.y.along_x, sky.z.along_x};
    const Vector3<double> j2 = {sky.x.along_y, sky.y.along_y, sky.z.along_y};
    const double a = dot(j1, j1);
    const double b = dot(j1, j2);
    const double c = dot(j2, j2);
    const double determinant = a * c - b * b;
    if (!(determinant > 1e-8 * a * c)) {
      return false;
    }
    const double x = (c * dot(j1, missing) - b * dot(j2, missing)) / determinant;
    const double y = (a * dot(j2, missing) - b * dot(j1, missing)) / determinant;
    const double length = std::hypot(x, y);
    const double part = length > 0.1 ? 0.1 / length : 1.0;
    view = normalized(view + (part * x) * across + (part * y) * up);
    if (!(dot(view, first) > std::cos(farthest))) {
      return false;
    }
    if (length < found) {
      return true;
    }
  }
  return false;
}

//! Computes the view directions of the leftmost and rightmost of 64 points on the shadow's edge.
void edge_sides(const StereoEye& eye, Vector3<double> (&sides)[2]) {
  const EyeCamera camera = eye.camera({0.0, 0.0, -1.0});
  const CameraStation station =
      make_camera_station(camera.spacetime, camera.r, camera.theta, 0.0, camera.motion, camera.velocity);
  const ShadowChart chart = make_shadow_chart(station);
  const Vector3<double> right = normalized(cross(in_view(camera, chart.centre), Vector3<double>{0.0, 1.0, 1e-9}));
  double maximum[2] = {-2.0, -2.0};
  constexpr int points = 64;
  for (int i = 0; i < points; ++i) {
    const double gamma = 360.0 * one_degree * i / points;
    const double alpha = edge_polar_angle(station, chart, gamma);
    const Vector3<double> view =
        in_view(camera, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma));
    const double side = dot(view, right);
    for (int k = 0; k < 2; ++k) {
      const double value = k == 0 ? -side : side;
      if (value > maximum[k]) {
        maximum[k] = value;
        sides[k] = view;
      }
    }
  }
}

//! Adds the disparities of the sky in many directions: each is followed from the left eye's ray to
//! the direction in which the right eye sees the same star.
void add_sky(const StereoEye& left, const StereoEye& right, std::span<const SeenDirection> directions,
             DisparityMeter& meter) {
  std::vector<std::optional<Vector3<double>>> others(directions.size());
  parallel_for(static_cast<int>(directions.size()), 4, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vector3<double>& view = directions[i].view;
      Vector3<EdgeDual> sky{};
      Vector3<double> other = view;
      if (directions[i].disparity_of == DisparityOf::sky && directions[i].shows_sky() &&
          sky_seen_by(left, {EdgeDual(view.x), EdgeDual(view.y), EdgeDual(view.z)}, sky) &&
          find_direction(right, values(sky), other)) {
        others[i] = other;
      }
    }
  });
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (others[i]) {
      meter.add_of_layer(directions[i].view, *others[i]);
    }
  }
}

void add_edge(const StereoEye& left, const StereoEye& right, DisparityMeter& meter) {
  Vector3<double> sides[2][2];
  edge_sides(left, sides[0]);
  edge_sides(right, sides[1]);
  meter.add(sides[0][0], sides[1][0]);
  meter.add(sides[0][1], sides[1][1]);
}

}  // namespace

std::optional<Disparity> frame_disparity(const Show& show, const CameraPose& pose, const Projection& projection,
                                         std::span<const PlacedOutline> objects, const PlacedMeshes& hiding) {
  if (eye_count(show.stereo) < 2) {
    return std::nullopt;
  }
  const StereoEye left(show, pose, -1.0);
  const StereoEye right(show, pose, 1.0);
  DisparityMeter meter(left, right, projection);
  const std::vector<SeenDirection> directions = seen_directions(show, pose, projection, hiding);
  if (!is_black(show.sky)) {
    add_sky(left, right, directions, meter);
  }
  add_near_things(show, pose, directions, objects, meter);
  // The shadow is visible only in front of the sky, the disk or shells.
  const bool shadow_seen = !is_black(show.sky) || show.disk || !show.shells.empty();
  if (eye_cameras(show.stereo.model) == EyeCameras::own && shadow_seen) {
    add_edge(left, right, meter);
  }
  return meter.result();
}

}  // namespace ergodome
