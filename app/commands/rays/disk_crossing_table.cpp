#include "app/commands/rays/disk_crossing_table.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "app/commands/rays/ray_groups.h"
#include "content/tables/number_text.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/disk/disk_emitter.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Rays end at this many times the camera's radius: farther out they no longer cross the equatorial
//! plane, except those that run along it.
constexpr double farthest = 1e6;
constexpr int step_limit = 100'000;
constexpr int rays_at_a_time = 16;

//! Returns φ of a crossing, in (-π, π].
double azimuth_of(const EquatorialCrossing<double>& crossing) {
  const double phi = std::remainder(std::atan2(crossing.y, crossing.x) + crossing.drag, 2.0 * pi);
  return phi <= -pi ? pi : phi;
}

//! Returns the lines of a ray; nothing if it does not converge.
std::optional<std::string> lines_of(const RayRow& row, const std::string& id, const CameraStation& camera,
                                    const DiskFlow<double>& flow, const CrossingTableOptions& options) {
  const NearRay<double> ray = start_near_ray(camera, row.direction);
  const CrossingLimits<double> limits = {camera.u / farthest, options.tolerance, step_limit};
  EquatorialCrossing<double> crossings[crossing_orders];
  if (!trace_crossings<20, true>(camera.spin, ray, limits, true, crossings)) {
    return std::nullopt;
  }
  std::string text;
  for (int order = 0; order < crossing_orders && crossings[order].u > 0.0; ++order) {
    const EquatorialCrossing<double>& at = crossings[order];
    const DiskLight<double> light = {1.0 / at.u, ray.energy, ray.axial_angular_momentum, ray.shear_constant,
                                     at.u_rate > 0.0};
    fmt::format_to(std::back_inserter(text), "{},{}", id, order);
    for (const double number : {light.r, azimuth_of(at), at.delay}) {
      text += ',';
      append_number(text, number);
    }
    text += ',';
    if (light.r >= flow.stable_r || options.plunging) {
      append_number(text, 1.0 / disk_frequency(flow, light));
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string crossing_lines(const RayTable& table, std::span<const RayRow> rows, const CrossingTableOptions& options) {
  const RayCamera& first = table.camera_of(rows.front());
  const CameraStation camera = station_of(first);
  const DiskFlow<double> flow = make_disk_flow(first.spacetime);
  std::vector<std::optional<std::string>> lines(rows.size());
  parallel_for(static_cast<int>(rows.size()), rays_at_a_time, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      lines[at] = lines_of(rows[at], table.id_of(rows[at]), camera, flow, options);
    }
  });
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i]) {
      throw Error("trace --disk", "ray " + table.id_of(rows[i]) + " did not converge", "choose a larger --tolerance");
    }
    text += *lines[i];
  }
  return text;
}

}  // namespace ergodome
