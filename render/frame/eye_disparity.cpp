#include "render/frame/eye_disparity.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/geodesic/taylor.h"
#include "kernels/projection/flat_parallax.h"
#include "kernels/shadow/critical_curve.h"
#include "render/frame/near_distances.h"
#include "render/frame/view_projection.h"
#include "render/lens/eye_camera.h"

namespace ergodome {

namespace {

using EdgeDual = Dual<double>;

constexpr int lattice = 9;
constexpr int order = 14;
constexpr int most_rounds = 12;
constexpr double found = 1e-7;
//! What moves farther than this is another image of the star [rad].
constexpr double farthest = 0.5;

//! One eye of a frame: for each direction of its view, a camera.
class Eye {
 public:
  Eye(const Show& show, const CameraPose& pose, double side)
      : show_(show), pose_(pose), offset_(0.5 * side * show.stereo.baseline) {}

  //! Where it sits when it looks in a direction, in the view's axes.
  [[nodiscard]] Vector3<double> place(const Vector3<double>& view) const {
    const StereoSettings& stereo = show_.stereo;
    if (stereo.model != StereoModel::omni) {
      return {stereo.model == StereoModel::flat ? 0.0 : offset_, 0.0, 0.0};
    }
    const double across = std::hypot(view.x, view.z);
    const double gone = std::cos(one_degree * stereo.fade_to_deg);
    const double ramp = std::clamp((across - gone) / (std::cos(one_degree * stereo.fade_from_deg) - gone), 0.0, 1.0);
    const double share = across > 0.0 ? offset_ * ramp * ramp * (3.0 - 2.0 * ramp) / across : 0.0;
    return {-view.z * share, 0.0, view.x * share};
  }

  [[nodiscard]] EyeCamera camera(const Vector3<double>& view) const { return eye_camera(show_, pose_, place(view)); }

  //! What a direction of an image that converges within itself is turned by: that of the model omni.
  [[nodiscard]] Vector3<double> convergence_turn(const Vector3<double>& view) const {
    const StereoSettings& stereo = show_.stereo;
    const bool turns = stereo.model == StereoModel::omni && stereo.convergence > 0.0;
    return turns ? (1.0 / stereo.convergence) * place(view) : Vector3<double>{0.0, 0.0, 0.0};
  }

  //! The eye's image: where it has directions.
  [[nodiscard]] Projection image(const Projection& projection) const {
    return show_.stereo.model == StereoModel::omni
               ? projection
               : converged_projection(projection, offset_, show_.stereo.convergence);
  }

 private:
  const Show& show_;
  const CameraPose& pose_;
  double offset_;
};

//! A place of the sky with its derivatives along two directions of the view; false for the shadow.
bool look(const Eye& from, const Vector3<EdgeDual>& seen, Vector3<EdgeDual>& sky) {
  const Vector3<double> middle = {seen.x.value, seen.y.value, seen.z.value};
  const EyeCamera eye = from.camera(middle);
  const Vector3<double> turn = from.convergence_turn(middle);
  const Vector3<EdgeDual> turned = {seen.x - turn.x, seen.y - turn.y, seen.z - turn.z};
  const EdgeDual inverse_length = 1.0 / sqrt(dot(turned, turned));
  const Vector3<EdgeDual> view = {turned.x * inverse_length, turned.y * inverse_length, turned.z * inverse_length};
  const CameraStation camera = make_camera_station(eye.spin, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
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

//! The direction in which an eye sees a place of the sky, near to a first guess; false where it is not found.
bool find_direction(const Eye& eye, const Vector3<double>& star, Vector3<double>& view) {
  const Vector3<double> first = view;
  for (int round = 0; round < most_rounds; ++round) {
    const Vector3<double> across =
        normalized(cross(std::abs(view.y) < 0.9 ? Vector3<double>{0, 1, 0} : Vector3<double>{1, 0, 0}, view));
    const Vector3<double> up = cross(view, across);
    Vector3<EdgeDual> sky{};
    if (!look(eye,
              {EdgeDual(view.x, across.x, up.x), EdgeDual(view.y, across.y, up.y), EdgeDual(view.z, across.z, up.z)},
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

//! Gathers what both eyes see.
class DisparityMeter {
 public:
  DisparityMeter(const Eye& left, const Eye& right, const Projection& projection)
      : images_{left.image(projection), right.image(projection)}, screen_(projection) {}

  void add(const Vector3<double>& left, const Vector3<double>& right) {
    double x[2];
    double y[2];
    if (!pixel_from_direction(images_[0], left, x[0], y[0]) || !pixel_from_direction(images_[1], right, x[1], y[1])) {
      return;
    }
    double pixels = x[1] - x[0];
    if (wraps_around(images_[0])) {
      pixels = std::remainder(pixels, images_[0].width_px);
    }
    // Where a viewer sees them: through an image that does not converge.
    const Vector3<double> from = direction_from_pixel(screen_, x[0], y[0]);
    const Vector3<double> to = direction_from_pixel(screen_, x[1], y[1]);
    const double turn = std::atan2(to.x, -to.z) - std::atan2(from.x, -from.z);
    // Azimuths lie closer towards the zenith.
    const double level = 0.5 * (std::hypot(from.x, from.z) + std::hypot(to.x, to.z));
    const double turned = 60.0 / one_degree * level * std::remainder(turn, 360.0 * one_degree);
    if (!any_) {
      disparity_ = {pixels, pixels, turned, turned};
      any_ = true;
    }
    disparity_ = {std::min(disparity_.least_px, pixels), std::max(disparity_.greatest_px, pixels),
                  std::min(disparity_.least_arcmin, turned), std::max(disparity_.greatest_arcmin, turned)};
  }

  [[nodiscard]] std::optional<Disparity> result() const { return any_ ? std::optional(disparity_) : std::nullopt; }

 private:
  Projection images_[2];
  Projection screen_;
  Disparity disparity_{};
  bool any_ = false;
};

//! The places of the shadow's edge that lie farthest to the left and to the right.
void edge_sides(const Eye& eye, Vector3<double> (&sides)[2]) {
  const EyeCamera camera = eye.camera({0.0, 0.0, -1.0});
  const CameraStation station =
      make_camera_station(camera.spin, camera.r, camera.theta, 0.0, camera.motion, camera.velocity);
  const ShadowChart chart = make_shadow_chart(station);
  const Vector3<double> right = normalized(cross(in_view(camera, chart.centre), Vector3<double>{0.0, 1.0, 1e-9}));
  double most[2] = {-2.0, -2.0};
  constexpr int points = 64;
  for (int i = 0; i < points; ++i) {
    const double gamma = 360.0 * one_degree * i / points;
    const double alpha = edge_polar_angle(station, chart, gamma);
    const Vector3<double> view =
        in_view(camera, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma));
    const double side = dot(view, right);
    for (int k = 0; k < 2; ++k) {
      const double value = k == 0 ? -side : side;
      if (value > most[k]) {
        most[k] = value;
        sides[k] = view;
      }
    }
  }
}

//! Adds what stands near the hole where flat space has it for both eyes of one lens.
void add_near_things(const Show& show, const CameraPose& pose, const Projection& projection, DisparityMeter& meter) {
  if (!show.disk && show.shells.empty()) {
    return;
  }
  const EyeCamera head = eye_camera(show, pose, 0.0);
  const Vector3<double> right = {0.5 * show.stereo.baseline, 0.0, 0.0};
  for (int row = 0; row < lattice; ++row) {
    for (int column = 0; column < lattice; ++column) {
      const double x = (column + 0.5) / lattice * projection.width_px;
      const double y = (row + 0.5) / lattice * projection.height_px;
      if (!(image_coverage(projection, x, y) > 0.0)) {
        continue;
      }
      const Vector3<double> view = direction_from_pixel(projection, x, y);
      for (const double distance : near_distances(show, head, view)) {
        meter.add(seen_by_eye(view, distance, -1.0 * right), seen_by_eye(view, distance, right));
      }
    }
  }
}

}  // namespace

std::optional<Disparity> frame_disparity(const Show& show, const CameraPose& pose, const Projection& projection) {
  if (eye_count(show.stereo) < 2) {
    return std::nullopt;
  }
  const Eye left(show, pose, -1.0);
  const Eye right(show, pose, 1.0);
  DisparityMeter meter(left, right, projection);
  for (int row = 0; row < lattice; ++row) {
    for (int column = 0; column < lattice; ++column) {
      const double x = (column + 0.5) / lattice * projection.width_px;
      const double y = (row + 0.5) / lattice * projection.height_px;
      if (!(image_coverage(projection, x, y) > 0.0)) {
        continue;
      }
      const Vector3<double> view = direction_from_pixel(projection, x, y);
      Vector3<EdgeDual> sky{};
      Vector3<double> other = view;
      if (look(left, {EdgeDual(view.x), EdgeDual(view.y), EdgeDual(view.z)}, sky) &&
          find_direction(right, values(sky), other)) {
        meter.add(view, other);
      }
    }
  }
  if (show.stereo.model == StereoModel::flat) {
    add_near_things(show, pose, projection, meter);
  }
  if (show.stereo.model == StereoModel::physical) {
    Vector3<double> sides[2][2];
    edge_sides(left, sides[0]);
    edge_sides(right, sides[1]);
    meter.add(sides[0][0], sides[1][0]);
    meter.add(sides[0][1], sides[1][1]);
  }
  return meter.result();
}

}  // namespace ergodome
