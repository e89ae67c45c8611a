#include "app/commands/rays/shell_crossing_table.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "app/commands/rays/ray_groups.h"
#include "content/tables/number_text.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/shells/shell_crossings.h"
#include "kernels/shells/shell_emitter.h"

namespace ergodome {

namespace {

constexpr int shell_step_limit = 100'000;
constexpr int shell_rays_at_a_time = 16;

//! Writes a line for each crossing of a ray while it is traced.
struct LineWriter {
  const std::string& id;
  double spin;
  const NearRay<double>& ray;
  double r;
  int count = 0;
  std::string text = {};

  void cross(int /*shell*/, bool lanes, const NearPosition<double>& at) {
    if (!lanes) {
      return;
    }
    const double theta = std::atan2(std::hypot(at.m.x, at.m.y), at.m.z);
    const double turned = std::remainder(std::atan2(at.m.y, at.m.x) + at.drag, 2.0 * pi);
    const double phi = turned <= -pi ? pi : turned;
    const double g =
        1.0 / zamo_frequency(spin, r, std::sin(theta), std::cos(theta), ray.energy, ray.axial_angular_momentum);
    fmt::format_to(std::back_inserter(text), "{},{}", id, count);
    for (const double number : {theta, phi, at.time, at.delay}) {
      text += ',';
      append_number(text, number);
    }
    text += at.u_rate > 0.0 ? ",1," : ",0,";
    append_number(text, g);
    text += '\n';
    ++count;
  }
  static void turn(bool /*lanes*/, const NearPosition<double>& /*at*/) {}
  [[nodiscard]] static bool done() { return false; }
};

//! Returns the lines of a ray, one for each crossing; nothing if it does not converge.
std::optional<std::string> lines_of(const RayRow& row, const std::string& id, const CameraStation& camera,
                                    const ShellTableOptions& options) {
  const NearRay<double> ray = start_near_ray(camera, row.direction);
  const double u = 1.0 / options.r;
  LineWriter writer{id, camera.spin, ray, options.r};
  if (!trace_shells<20, NearParts::azimuth_and_delay>(camera.spin, ray, {&u, 1}, {options.tolerance, shell_step_limit},
                                                      true, writer)) {
    return std::nullopt;
  }
  return writer.text;
}

}  // namespace

std::string shell_lines(const RayTable& table, std::span<const RayRow> rows, const ShellTableOptions& options) {
  const RayCamera& first = table.camera_of(rows.front());
  const double horizon_r = horizon_radius(first.spacetime);
  if (!(options.r > horizon_r)) {
    throw Error("trace --shell",
                fmt::format("{} M is inside the horizon: for ray {}, the horizon is at {:.6g} M", options.r,
                            table.id_of(rows.front()), horizon_r),
                fmt::format("choose a radius above {:.6g}", horizon_r));
  }
  const CameraStation camera = station_of(first);
  std::vector<std::optional<std::string>> lines(rows.size());
  parallel_for(static_cast<int>(rows.size()), shell_rays_at_a_time, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      lines[at] = lines_of(rows[at], table.id_of(rows[at]), camera, options);
    }
  });
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i]) {
      throw Error("trace --shell", "ray " + table.id_of(rows[i]) + " did not converge", "choose a larger --tolerance");
    }
    text += *lines[i];
  }
  return text;
}

}  // namespace ergodome
