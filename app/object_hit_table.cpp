#include "app/object_hit_table.h"

#include <fmt/format.h>

#include <vector>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int rays_at_a_time = 16;

std::string line_of(const RayRow& row, const CameraStation& camera, const ObjectRays& objects, double tolerance) {
  const MeshHit hit = objects.look(camera, row.direction, tolerance);
  if (hit.mesh < 0) {
    return {};
  }
  return fmt::format("{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", row.id, hit.mesh,
                     objects.triangle(hit), hit.weight_1, hit.weight_2, hit.point.x, hit.point.y, hit.point.z,
                     hit.delay);
}

}  // namespace

std::string object_lines(std::span<const RayRow> rows, const ObjectRays& objects, double tolerance) {
  const RayRow& first = rows.front();
  const CameraStation camera = make_camera_station(first.spin, first.r, first.theta, 0.0, first.motion, first.velocity);
  std::vector<std::string> lines(rows.size());
  parallel_for(static_cast<int>(rows.size()), rays_at_a_time, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      lines[at] = line_of(rows[at], camera, objects, tolerance);
    }
  });
  std::string text;
  for (const std::string& line : lines) {
    text += line;
  }
  return text;
}

}  // namespace ergodome
