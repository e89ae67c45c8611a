#include "app/commands/rays/object_hit_table.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "content/tables/number_text.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int object_rays_at_a_time = 16;

//! Returns the line of a ray; an empty text if it hits no object, no value if it does not converge.
std::optional<std::string> line_of(const RayRow& row, const CameraStation& camera, const ObjectRays& objects,
                                   double tolerance) {
  const std::optional<MeshHit> hit = objects.first_hit(camera, row.direction, tolerance);
  if (!hit) {
    return std::nullopt;
  }
  if (hit->mesh < 0) {
    return std::string();
  }
  std::string text = fmt::format("{},{},{}", row.id, hit->mesh, objects.triangle(*hit));
  for (const double number : {hit->weight_1, hit->weight_2, hit->point.x, hit->point.y, hit->point.z, hit->delay}) {
    text += ',';
    append_number(text, number);
  }
  return text += '\n';
}

}  // namespace

std::string object_lines(std::span<const RayRow> rows, const ObjectRays& objects, double tolerance) {
  const RayRow& first = rows.front();
  const CameraStation camera =
      make_camera_station(first.spacetime, first.r, first.theta, 0.0, first.motion, first.velocity);
  std::vector<std::optional<std::string>> lines(rows.size());
  parallel_for(static_cast<int>(rows.size()), object_rays_at_a_time, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      lines[at] = line_of(rows[at], camera, objects, tolerance);
    }
  });
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i]) {
      throw Error("trace --objects", fmt::format("ray {} did not converge", rows[i].id), "choose a larger --tolerance");
    }
    text += *lines[i];
  }
  return text;
}

}  // namespace ergodome
