#include "app/commands/rays/object_hit_table.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "app/commands/rays/ray_groups.h"
#include "content/tables/number_text.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int object_rays_at_a_time = 16;

//! Returns the line of a ray; an empty text if it hits no object, no value if it does not converge.
std::optional<std::string> line_of(const RayRow& row, const std::string& id, const CameraStation& camera,
                                   const ObjectRays& objects, double tolerance) {
  const std::optional<MeshHit> hit = objects.first_hit(camera, row.direction, tolerance);
  if (!hit) {
    return std::nullopt;
  }
  if (hit->mesh < 0) {
    return std::string();
  }
  std::string text = fmt::format("{},{},{}", id, hit->mesh, objects.triangle(*hit));
  for (const double number : {hit->weight_1, hit->weight_2, hit->point.x, hit->point.y, hit->point.z, hit->delay}) {
    text += ',';
    append_number(text, number);
  }
  return text += '\n';
}

}  // namespace

std::string object_lines(const RayTable& table, std::span<const RayRow> rows, const ObjectRays& objects,
                         double tolerance) {
  const CameraStation camera = station_of(table.camera_of(rows.front()));
  std::vector<std::optional<std::string>> lines(rows.size());
  parallel_for(static_cast<int>(rows.size()), object_rays_at_a_time, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      lines[at] = line_of(rows[at], table.id_of(rows[at]), camera, objects, tolerance);
    }
  });
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i]) {
      throw Error("trace --objects", fmt::format("ray {} did not converge", table.id_of(rows[i])),
                  "choose a larger --tolerance");
    }
    text += *lines[i];
  }
  return text;
}

}  // namespace ergodome
