#include "content/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

namespace {

//! Minimum of twice the area over the square of the longest side of a triangle, about the rounding
//! error of a float. Below it, a triangle counts as a line.
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

Vector3<double> numbers_of(const float (&from)[3]) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

bool has_length(const Vector3<double>& normal) {
  constexpr double least_square = 1e-12;
  const double square = dot(normal, normal);
  return square > least_square && std::isfinite(square);
}

//! Returns a vector of twice a triangle's area, along its normal.
Vector3<double> area_of(const TriangleMesh& mesh, std::size_t first) {
  const auto corner = [&](std::size_t i) { return numbers_of(mesh.vertices[mesh.indices[first + i]].position); };
  return cross(corner(1) - corner(0), corner(2) - corner(0));
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
  double maximum = 0.0;
  for (const std::uint32_t index : mesh.indices) {
    const float(&p)[3] = mesh.vertices[index].position;
    maximum =
        std::max(maximum, std::hypot(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])));
  }
  return maximum;
}

void repair_normals(TriangleMesh& mesh) {
  std::vector<bool> wanting(mesh.vertices.size());
  bool any = false;
  for (std::size_t i = 0; i < wanting.size(); ++i) {
    wanting[i] = !has_length(numbers_of(mesh.vertices[i].normal));
    any = any || wanting[i];
  }
  if (!any) {
    return;
  }
  constexpr Vector3<double> none{0.0, 0.0, 0.0};
  std::vector<Vector3<double>> sums(mesh.vertices.size(), none);
  // The first face at each vertex is the fallback: duplicate faces with opposite winding sum to
  // zero.
  std::vector<Vector3<double>> firsts(mesh.vertices.size(), none);
  for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
    const Vector3<double> area = area_of(mesh, first);
    for (std::size_t i = first; i < first + 3; ++i) {
      Vector3<double>& sum = sums[mesh.indices[i]];
      Vector3<double>& of_first = firsts[mesh.indices[i]];
      sum = sum + area;
      of_first = dot(of_first, of_first) > 0.0 ? of_first : area;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    constexpr double min_part = 1e-12;
    const bool cancelled = dot(sums[i], sums[i]) <= min_part * dot(firsts[i], firsts[i]);
    const Vector3<double>& sum = cancelled ? firsts[i] : sums[i];
    const double length = std::sqrt(dot(sum, sum));
    if (wanting[i] && length > 0.0) {
      float(&normal)[3] = mesh.vertices[i].normal;
      normal[0] = static_cast<float>(sum.x / length);
      normal[1] = static_cast<float>(sum.y / length);
      normal[2] = static_cast<float>(sum.z / length);
    }
  }
}

}  // namespace ergodome
