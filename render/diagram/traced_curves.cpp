#include "render/diagram/traced_curves.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "render/diagram/spread_choice.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

namespace {

constexpr int diagram_series = 16;
constexpr double diagram_tolerance = 1e-10;
constexpr int diagram_step_limit = 10'000;
//! Number of straight lines that approximate an integration step of a ray, which is a Taylor
//! series.
constexpr int lines_a_step = 12;
//! Minimum radius of drawn paths into the hole, in radii of the horizon. Closer to the horizon,
//! their azimuth grows without bound.
constexpr double beside_the_hole = 1.01;

using DiagramStep = PathStep<diagram_series, NearParts::azimuth_and_delay, double>;

double distance_of(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

//! Returns the angle between two positions, seen from the hole.
double angle_between(const Vector3<double>& a, const Vector3<double>& b) {
  return std::atan2(distance_of(cross(a, b)), dot(a, b));
}

//! A ray through a pixel of the coarse picture, and what it hits.
struct SightHit {
  Vector3<double> view;  //!< direction in the view's axes
  Vector3<double> n;     //!< direction in the observer's frame (e_r, e_θ, e_φ)
  MeshHit hit;
  int order = 0;  //!< image order of the hit object; 0: the ray hits no object
};

Vector3<double> in_eye_frame(const EyeCamera& eye, const Vector3<double>& view) {
  const auto& m = eye.frame_from_view;
  return {m[0][0] * view.x + m[0][1] * view.y + m[0][2] * view.z,
          m[1][0] * view.x + m[1][1] * view.y + m[1][2] * view.z,
          m[2][0] * view.x + m[2][1] * view.y + m[2][2] * view.z};
}

//! Traces a ray through the center of each pixel that is at least half covered by the image (a
//! fisheye's image covers only a circle). Returns the rays that converged.
std::vector<SightHit> sights_through(const EyeCamera& eye, const Projection& coarse, const ObjectRays& objects,
                                     double reach) {
  const CameraStation camera = station_of(eye);
  std::vector<std::vector<SightHit>> rows(static_cast<std::size_t>(coarse.height_px));
  parallel_for(coarse.height_px, 1, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < coarse.width_px; ++x) {
        if (!(image_coverage(coarse, x + 0.5, y + 0.5) >= 0.5)) {
          continue;
        }
        SightHit sight;
        sight.view = direction_from_pixel(coarse, x + 0.5, y + 0.5);
        sight.n = in_eye_frame(eye, sight.view);
        const std::optional<MeshHit> hit = objects.first_hit(camera, sight.n, diagram_tolerance);
        if (hit) {
          sight.hit = *hit;
          sight.order = hit->mesh >= 0 ? traced_curve(camera, sight.n, sight.hit, reach).order : 0;
          rows[static_cast<std::size_t>(y)].push_back(sight);
        }
      }
    }
  });
  std::vector<SightHit> all;
  for (const std::vector<SightHit>& row : rows) {
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

//! Selects some of the rays, spread over the view.
std::vector<SightHit> spread_over_view(const std::vector<SightHit>& from, std::size_t count) {
  std::vector<Vector3<double>> views;
  views.reserve(from.size());
  for (const SightHit& sight : from) {
    views.push_back(sight.view);
  }
  std::vector<SightHit> taken;
  for (const std::size_t i : spread_choice(views, count)) {
    taken.push_back(from[i]);
  }
  return taken;
}

}  // namespace

TracedCurve traced_curve(const CameraStation& camera, const Vector3<double>& n, const MeshHit& hit, double reach) {
  TracedCurve curve;
  double swept = 0.0;
  const double min_r = beside_the_hole * camera.horizon_r;
  bool inside = false;
  const auto add = [&](const Vector3<double>& position) {
    if (!curve.positions.empty()) {
      swept += angle_between(curve.positions.back(), position);
    }
    curve.positions.push_back(position);
  };
  const auto visit = [&](int, const DiagramStep& step) {
    const double hit_h = (hit.time - step.start) * step.scale;
    const bool ends = hit.mesh >= 0 && hit_h <= step.length;
    const double length = ends ? hit_h : step.length;
    for (int i = curve.positions.empty() ? 0 : 1; i <= lines_a_step; ++i) {
      const Vector3<double> position = step.point(length * i / lines_a_step);
      const double r = distance_of(position);
      inside = r < 2.0 * min_r;
      if (hit.mesh < 0 && (r < min_r || r > reach)) {
        return true;
      }
      add(position);
    }
    return ends;
  };
  follow_path<diagram_series, NearParts::azimuth_and_delay>(
      camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, n), {min_r, 1.5 * reach},
      MeshLimits{diagram_tolerance, diagram_step_limit}, true, visit);
  std::ranges::reverse(curve.positions);
  curve.end = hit.mesh >= 0 ? CurveEnd::object : inside ? CurveEnd::hole : CurveEnd::sky;
  curve.object = hit.mesh;
  curve.order = 1 + static_cast<int>(swept / pi);
  curve.delay = hit.delay;
  return curve;
}

std::vector<TracedCurve> traced_curves(const EyeCamera& eye, const Projection& coarse, const ObjectRays& objects,
                                       const TracedChoice& choice) {
  std::map<int, std::vector<SightHit>> orders;
  std::vector<SightHit> others;
  for (const SightHit& sight : sights_through(eye, coarse, objects, choice.reach)) {
    if (sight.order == 0) {
      others.push_back(sight);
    } else if (sight.order <= choice.max_order) {
      orders[sight.order].push_back(sight);
    }
  }
  const auto wanted = static_cast<std::size_t>(choice.count);
  std::size_t left = 2 * wanted / 3;
  std::size_t orders_left = orders.size();
  std::vector<SightHit> taken;
  for (const auto& [order, of_order] : orders) {
    const std::vector<SightHit> some = spread_over_view(of_order, left / orders_left--);
    left -= some.size();
    taken.insert(taken.end(), some.begin(), some.end());
  }
  const std::vector<SightHit> rest = spread_over_view(others, wanted - taken.size());
  taken.insert(taken.end(), rest.begin(), rest.end());
  std::vector<TracedCurve> curves;
  curves.reserve(taken.size());
  for (const SightHit& sight : taken) {
    curves.push_back(traced_curve(station_of(eye), sight.n, sight.hit, choice.reach));
  }
  return curves;
}

}  // namespace ergodome
