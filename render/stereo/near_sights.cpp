#include "render/stereo/near_sights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "kernels/core/find_root.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/objects/mesh_search.h"
#include "render/lens/direct_lens.h"
#include "render/passes/disk/disk_pass.h"

namespace ergodome {

namespace {

constexpr double ray_tolerance = 1e-7;
constexpr int max_steps = 2000;
//! Minimum distance from the horizon to which rays are traced, as a fraction of the horizon's
//! radius.
constexpr double horizon_margin = 1e-6;

template <NearParts Parts>
using StepWith = PathStep<near_order, Parts, double>;
using Step = StepWith<NearParts::azimuth_and_distance>;

//! Traces light backwards from a direction of a head's view until it can no longer come between two
//! radii, or visit(step) returns true. Calls `visit` for each step that may be between them.
template <NearParts Parts, class Visit>
void follow_until(const EyeCamera& head, const Vector3<double>& view, const RadialBounds& bounds, Visit&& visit) {
  const CameraStation camera = station_of(head);
  const double(&m)[3][3] = head.frame_from_view;
  const auto row = [&](int i) { return m[i][0] * view.x + m[i][1] * view.y + m[i][2] * view.z; };
  const RadialBounds outside = {std::max(bounds.minimum, camera.horizon_r * (1.0 + horizon_margin)),
                                std::max(bounds.maximum, 1.01 * camera.horizon_r)};
  follow_path<near_order, Parts>(camera.spin, camera.cosine_phi, camera.sine_phi,
                                 start_near_ray(camera, Vector3<double>{row(0), row(1), row(2)}), outside,
                                 MeshLimits{ray_tolerance, max_steps, -head.clock_lead}, true,
                                 [&](int, const StepWith<Parts>& step) { return visit(step); });
}

//! Traces light backwards until it can no longer come between two radii, and calls visit(step) for
//! each step that may be between them.
template <class Visit>
void follow(const EyeCamera& head, const Vector3<double>& view, const RadialBounds& bounds, Visit&& visit) {
  follow_until<NearParts::azimuth_and_distance>(head, view, bounds, [&](const Step& step) {
    visit(step);
    return false;
  });
}

//! Calls found(time) for the sign changes of function(time) between successive times of a step.
template <class Function, class Found>
void find_crossings(std::span<const double> times, Function&& function, Found&& found) {
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double from = function(times[i]);
    if ((from < 0.0) != (function(times[i + 1]) < 0.0)) {
      const double side = from < 0.0 ? 1.0 : -1.0;
      found(find_root(times[i], times[i + 1], [&](double h) { return side * function(h); }));
    }
  }
}

//! Returns the times of a step between which r is monotonic. Outside the horizon, a light path has
//! at most one turning point.
std::vector<double> radial_legs(const Step& step) {
  const auto rate = [&](double h) { return series_rate(step.series.u, h); };
  const double side = rate(0.0) < 0.0 ? 1.0 : -1.0;
  if (!(side * rate(step.length) > 0.0)) {
    return {0.0, step.length};
  }
  return {0.0, find_root(0.0, step.length, [&](double h) { return side * rate(h); }), step.length};
}

//! Calls found(time) for the times of a step at which light is at radius `r`. `legs`:
//! radial_legs().
template <class Found>
void find_radius(const Step& step, std::span<const double> legs, double r, Found&& found) {
  find_crossings(
      legs, [&](double h) { return series_value(step.series.u, h) - 1.0 / r; }, found);
}

//! Collects the points where a ray meets one disk or shell, between two radii.
class Meetings {
 public:
  Meetings(double min_r, double max_r, double opacity) : min_r_(min_r), max_r_(max_r), opaque_(opacity > 0.9) {}

  //! Adds a meeting point, unless it is at the start of the ray or outside the radii. One outside
  //! the radii counts as the first meeting all the same.
  void add(const Step& step, double h, std::vector<NearSight>& sights) {
    const Vector3<double> position = step.point(h);
    const double r = std::sqrt(dot(position, position));
    const double distance = step.distance(h);
    if (!(distance > 1e-9 * r)) {
      return;
    }
    if (r >= min_r_ && r <= max_r_) {
      sights.push_back({position, distance, !any_, opaque_});
    }
    any_ = true;
  }

 private:
  double min_r_;
  double max_r_;
  bool opaque_;
  bool any_ = false;
};

}  // namespace

std::vector<NearSight> near_sights(const Show& show, const EyeCamera& head, const Vector3<double>& view) {
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  RadialBounds bounds = {everywhere, 0.0};
  const auto reach = [&](double min_r, double max_r) {
    bounds = {std::min(bounds.minimum, min_r), std::max(bounds.maximum, max_r)};
  };
  std::optional<Meetings> disk;
  if (show.disk && show.disk->opacity > 0.0) {
    const double inner = inner_edge(*show.disk, spacetime_of(show));
    disk.emplace(inner, show.disk->outer, show.disk->opacity);
    // Also counts crossings of the equatorial plane outside the disk: after one, light comes by the
    // long way round the hole.
    reach(inner, std::max(show.disk->outer, 1.01 * head.r));
  }
  std::vector<std::pair<double, Meetings>> shells;
  for (const ShellSettings& shell : show.shells) {
    if (is_visible(shell)) {
      shells.emplace_back(shell.radius, Meetings(0.0, everywhere, shell.fill_opacity));
      reach(0.999 * shell.radius, 1.001 * shell.radius);
    }
  }
  std::vector<NearSight> sights;
  if (!(bounds.maximum > 0.0)) {
    return sights;
  }
  follow(head, view, bounds, [&](const Step& step) {
    if (disk) {
      const double times[3] = {0.0, 0.5 * step.length, step.length};
      find_crossings(
          times, [&](double h) { return step.point(h).z; }, [&](double h) { disk->add(step, h, sights); });
    }
    const std::vector<double> legs = radial_legs(step);
    for (auto& [radius, shell] : shells) {
      find_radius(step, legs, radius, [&, &sphere = shell](double h) { sphere.add(step, h, sights); });
    }
  });
  std::ranges::sort(sights, {}, &NearSight::distance);
  const auto last = std::ranges::find_if(sights, &NearSight::opaque);
  if (last != sights.end()) {
    sights.erase(last + 1, sights.end());
  }
  return sights;
}

double distance_of_objects(const PlacedMeshes& meshes, const EyeCamera& head, const Vector3<double>& view) {
  constexpr NearParts parts = NearParts::azimuth_delay_and_distance;
  double distance = std::numeric_limits<double>::infinity();
  const MeshScene scene = meshes.around(head.spacetime, meshes.meshes.data());
  follow_until<parts>(head, view, {scene.min_r, scene.max_r}, [&](const StepWith<parts>& step) {
    detail::StepSearch<near_order, parts> search = {step, scene, 0.0, {}};
    const bool found = search.run();
    distance = found ? step.distance(search.found_h) : distance;
    return found;
  });
  return distance;
}

std::optional<double> distance_of_position(const EyeCamera& head, const Vector3<double>& view,
                                           const Vector3<double>& position) {
  const double r = std::sqrt(dot(position, position));
  double min_off = 1e-3 * r;
  std::optional<double> distance;
  follow(head, view, {0.99 * r, 1.01 * r}, [&](const Step& step) {
    const auto look_at = [&](double h) {
      const Vector3<double> aside = step.point(h) - position;
      const double off = std::sqrt(dot(aside, aside));
      if (off < min_off) {
        min_off = off;
        distance = step.distance(h);
      }
    };
    const std::vector<double> legs = radial_legs(step);
    find_radius(step, legs, r, look_at);
    // Light that turns back at this radius may just fail to reach it, so the turning point is
    // examined, too.
    if (legs.size() > 2) {
      look_at(legs[1]);
    }
  });
  return distance;
}

}  // namespace ergodome
