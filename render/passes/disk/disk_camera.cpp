#include "render/passes/disk/disk_camera.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/lens/grid/edge_table.h"

namespace ergodome {

namespace {

constexpr int layer_step_limit = 100;

}  // namespace

LayerLimits<double> layer_limits(Spacetime spacetime, double inner_r, double outer_r) {
  const double horizon = horizon_radius(spacetime);
  // Light from outside that turns back does so at or outside the prograde photon orbit.
  const double turning = photon_orbit_radius(Spacetime{std::abs(spacetime.spin)}, 1.0);
  const double near_r =
      horizon + std::max(std::min(0.25 * (inner_r - horizon), 0.5 * (turning - horizon)), 1e-3 * horizon);
  const double near_u = 1.0 / near_r;
  const double far_u = 0.25 / outer_r;
  const double room = near_u - far_u;
  return {near_u, far_u, near_u + room, far_u - 0.5 * room, 0.0, layer_step_limit};
}

DiskSpanOnScreen disk_span_on_screen(const DiskGridSettings& settings, double r) {
  const double outer_u = 1.0 / settings.outer_r;
  const double inner_u = 1.0 / settings.inner_r;
  const double pixels = std::min(pi, 2.0 * settings.outer_r / r) / settings.pixel;
  return {static_cast<float>(outer_u), static_cast<float>(inner_u),
          static_cast<float>(0.1 * (inner_u - outer_u) / pixels), static_cast<float>(0.2 / pixels)};
}

DiskChartCamera::DiskChartCamera(Spacetime spacetime, const LensPosition& position, const DiskGridSettings& settings)
    : rain(make_camera_station(spacetime, position.r, position.theta, 0.0, ObserverMotion::rain)),
      mirrored(std::abs(position.theta - 0.5 * pi) < 1e-9) {
  const ShadowChart chart = make_shadow_chart(rain);
  polar_angle = solve_edge(rain, chart, edge_points, mirrored);
  edge = edge_view(chart, polar_angle);
  const LayerLimits<double> limits = layer_limits(spacetime, settings.inner_r, settings.outer_r);
  const double tolerance = std::clamp(0.005 * settings.budget_px * settings.pixel, 3e-7, 1e-5);
  camera = {{converted_station<float>(rain), {edge, 1.0F}, {}},
            {static_cast<float>(limits.near_u), static_cast<float>(limits.far_u), static_cast<float>(limits.highest_u),
             static_cast<float>(limits.lowest_u), static_cast<float>(tolerance), limits.step_limit},
            settings.pattern};
}

}  // namespace ergodome
