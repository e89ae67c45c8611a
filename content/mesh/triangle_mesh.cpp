#include "content/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Twice the area over the square of the longest side below which a triangle counts as a line: a
//! few roundings of a float.
constexpr double thinnest = 1e-7;

//! Returns true if three corners span an area; false if a coordinate is NaN, as comparisons with it
//! fail.
bool has_area(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c) {
  double along_b[3];
  double along_c[3];
  double longest = 0.0;
  double square_b = 0.0;
  double square_c = 0.0;
  double square_bc = 0.0;
  for (int i = 0; i < 3; ++i) {
    along_b[i] = static_cast<double>(b.position[i]) - static_cast<double>(a.position[i]);
    along_c[i] = static_cast<double>(c.position[i]) - static_cast<double>(a.position[i]);
    square_b += along_b[i] * along_b[i];
    square_c += along_c[i] * along_c[i];
    square_bc += (along_b[i] - along_c[i]) * (along_b[i] - along_c[i]);
  }
  longest = std::max({square_b, square_c, square_bc});
  const double x = along_b[1] * along_c[2] - along_b[2] * along_c[1];
  const double y = along_b[2] * along_c[0] - along_b[0] * along_c[2];
  const double z = along_b[0] * along_c[1] - along_b[1] * along_c[0];
  return std::sqrt(x * x + y * y + z * z) > thinnest * longest && std::isfinite(longest);
}

}  // namespace

void drop_degenerate_triangles(TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (MeshPart& part : mesh.parts) {
    const std::size_t first = kept;
    const std::size_t end = std::size_t{part.first_index} + part.index_count;
    for (std::size_t i = part.first_index; i + 2 < end; i += 3) {
      const std::array corners = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
      if (has_area(mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]])) {
        std::ranges::copy(corners, mesh.indices.begin() + static_cast<long>(kept));
        kept += 3;
      } else {
        ++mesh.dropped_triangles;
      }
    }
    part.first_index = static_cast<std::uint32_t>(first);
    part.index_count = static_cast<std::uint32_t>(kept - first);
  }
  mesh.indices.resize(kept);
  std::erase_if(mesh.parts, [](const MeshPart& part) { return part.index_count == 0; });
}

double radius_of(const TriangleMesh& mesh) {
  double greatest = 0.0;
  for (const std::uint32_t index : mesh.indices) {
    const float(&p)[3] = mesh.vertices[index].position;
    greatest =
        std::max(greatest, std::hypot(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])));
  }
  return greatest;
}

}  // namespace ergodome
