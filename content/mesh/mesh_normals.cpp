#include "content/mesh/mesh_normals.h"

#include <cmath>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

namespace {

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
    constexpr double least_part = 1e-12;
    const bool cancelled = dot(sums[i], sums[i]) <= least_part * dot(firsts[i], firsts[i]);
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
