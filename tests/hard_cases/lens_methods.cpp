#include "tests/hard_cases/lens_methods.h"

#include <memory>

#include "content/trajectory/station_codec.h"
#include "kernels/launch/launch.h"
#include "render/lens/grid/grid_builder.h"
#include "render/lens/stations/station_blend.h"
#include "render/published/quadtree_builder.h"
#include "tests/support/sanitized.h"

namespace ergodome::test {

namespace {

//! Directions and results of rays, in the array layout of the kernels.
template <class S>
struct Arrays {
  std::vector<S> n[3], sky[3], status;

  explicit Arrays(const Directions& rays) : status(rays.size()) {
    for (const Vector3<double>& ray : rays) {
      n[0].push_back(static_cast<S>(ray.x));
      n[1].push_back(static_cast<S>(ray.y));
      n[2].push_back(static_cast<S>(ray.z));
    }
    for (std::vector<S>& component : sky) {
      component.resize(rays.size());
    }
  }

  RayBatch<S> batch(const CameraStationOf<S>& camera, const IntegrationSettings& settings, TraceMethod method) {
    RayBatch<S> all{};
    all.camera = camera;
    all.settings = settings;
    all.method = method;
    all.count = static_cast<int>(status.size());
    for (int k = 0; k < 3; ++k) {
      all.direction[k] = n[k].data();
      all.sky[k] = sky[k].data();
    }
    all.status = status.data();
    return all;
  }

  [[nodiscard]] SeenSky seen() const {
    SeenSky result;
    for (int k = 0; k < 3; ++k) {
      result.sky[k].assign(sky[k].begin(), sky[k].end());
    }
    result.status.assign(status.begin(), status.end());
    return result;
  }
};

//! Maximum number of steps. No method needs as many, except next to an extremal horizon.
constexpr int step_limit = 20'000;

Aberration observer_of(const CameraState& p) {
  return aberration_to_rain(Spacetime{p.spin}, p.r, p.theta, p.motion, p.beta);
}

LensStation built_station(const CameraState& camera_state, Nodes nodes) {
  GridSettings settings;
  settings.pixel = dome_pixel;
  settings.budget_px = sanitized ? 1.0 : 0.1;
  settings.observer = observer_of(camera_state);
  settings.fine = nodes == Nodes::in_double;
  return build_lens_station(Spacetime{camera_state.spin}, camera_state.r, camera_state.theta, settings);
}

std::shared_ptr<const StationBuffers> streamed(const LensStation& station) {
  const PackedBytes packed = pack_station(station);
  return std::make_shared<StationBuffers>(Backend::cpu,
                                          unpack_station(packed.bytes, packed.unpacked_bytes, "a station of a test"));
}

}  // namespace

SeenSky by_rays(const CameraState& camera_state, const Directions& rays, TraceMethod method, double tolerance) {
  Arrays<double> arrays(rays);
  launch(Backend::cpu, arrays.batch(station_at(camera_state), {tolerance, step_limit}, method));
  return arrays.seen();
}

SeenSky by_float_rays(const CameraState& camera_state, const Directions& rays, TraceMethod method, double tolerance) {
  Arrays<float> arrays(rays);
  launch(Backend::cpu,
         arrays.batch(converted_station<float>(station_at(camera_state)), {tolerance, step_limit, true}, method));
  return arrays.seen();
}

SeenSky by_lens(const LensBlend& lens, const CameraState& camera_state, const Directions& rays) {
  Arrays<double> arrays(rays);
  LookUpRaysBatch<double> batch{};
  batch.rays = arrays.batch(station_at(camera_state), {1e-10, step_limit}, TraceMethod::taylor);
  batch.lens = lens;
  batch.aberration = observer_of(camera_state);
  launch(Backend::cpu, batch);
  return arrays.seen();
}

SeenSky by_live_grid(const CameraState& camera_state, const Directions& rays, Nodes nodes) {
  const StationBlend lens(std::make_shared<StationBuffers>(Backend::cpu, built_station(camera_state, nodes)));
  return by_lens(lens.view(), camera_state, rays);
}

SeenSky by_streamed_stations(const CameraState& camera_state, const Directions& rays) {
  // Typical distance between baked stations at this position: a fraction of the height above the
  // horizon.
  const double apart = 0.01 * (camera_state.r - horizon_radius(Spacetime{camera_state.spin}));
  CameraState inner = camera_state;
  CameraState outer = camera_state;
  inner.r -= 0.5 * apart;
  outer.r += 0.5 * apart;
  const StationBlend blend(Backend::cpu, streamed(built_station(inner, Nodes::in_double)),
                           streamed(built_station(outer, Nodes::in_double)), {camera_state.r, camera_state.theta});
  return by_lens(blend.view(), camera_state, rays);
}

SeenSky by_quadtree(const CameraState& camera_state, const Directions& rays) {
  const CameraStation camera = station_at(camera_state);
  QuadtreeSettings settings;
  settings.coarsest_level = sanitized ? 4 : 6;
  settings.finest_level = sanitized ? 6 : 10;
  const QuadtreeLens lens(camera, false, settings);
  Arrays<double> arrays(rays);
  const QuadtreeRaysBatch batch = {arrays.batch(camera, {1e-9, step_limit}, TraceMethod::taylor),
                                   look_up_of(lens.view(), QuadtreeInterpolation::spline)};
  launch(Backend::cpu, batch);
  return arrays.seen();
}

}  // namespace ergodome::test
