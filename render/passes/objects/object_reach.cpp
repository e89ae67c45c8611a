#include "render/passes/objects/object_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ergodome {

namespace {

//! Returns the squared distance of a segment from the origin.
double square_to_segment(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> way = b - a;
  const double along = std::clamp(-dot(a, way) / std::max(dot(way, way), 1e-300), 0.0, 1.0);
  const Vector3<double> nearest = a + along * way;
  return dot(nearest, nearest);
}

}  // namespace

double distance_from_origin(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c) {
  const Vector3<double> normal = cross(b - a, c - a);
  // The origin projects to the inside of the triangle if it is on the same side of all three edges.
  const bool inside =
      dot(cross(b - a, normal), a) >= 0.0 && dot(cross(c - b, normal), b) >= 0.0 && dot(cross(a - c, normal), c) >= 0.0;
  if (inside) {
    return std::abs(dot(normal, a)) / std::sqrt(dot(normal, normal));
  }
  return std::sqrt(std::min({square_to_segment(a, b), square_to_segment(b, c), square_to_segment(c, a)}));
}

RadialRange radial_range(const TriangleMesh& mesh, const ObjectPlacement& placement, double size, double radius) {
  const double from_hole = std::sqrt(dot(placement.position, placement.position));
  if (from_hole - radius > nearest_of_objects) {
    return {from_hole - radius, from_hole + radius};
  }
  const auto position = [&](std::size_t index) {
    const float(&p)[3] = mesh.vertices[mesh.indices[index]].position;
    Vector3<double> at = placement.position;
    double* const part[3] = {&at.x, &at.y, &at.z};
    for (int i = 0; i < 3; ++i) {
      const double(&row)[3] = placement.rows[i];
      *part[i] += size * (row[0] * static_cast<double>(p[0]) + row[1] * static_cast<double>(p[1]) +
                          row[2] * static_cast<double>(p[2]));
    }
    return at;
  };
  RadialRange range{std::numeric_limits<double>::infinity(), from_hole + radius};
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    range.nearest = std::min(range.nearest, distance_from_origin(position(i), position(i + 1), position(i + 2)));
  }
  return range;
}

}  // namespace ergodome
