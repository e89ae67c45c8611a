#include "render/passes/objects/polygons/object_outline.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

constexpr std::size_t max_triangles = 2048;

Vector3<double> position_of(const SurfaceVertex& vertex) {
  const float(&p)[3] = vertex.position;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

bool is_finite(const Vector3<double>& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Vector3<double> nearest_of_side(const Vector3<double>& point, const Vector3<double>& from, const Vector3<double>& to) {
  const Vector3<double> way = to - from;
  const double share = std::clamp(dot(point - from, way) / std::max(dot(way, way), 1e-300), 0.0, 1.0);
  return from + share * way;
}

}  // namespace

MeshOutline outline_of(const TriangleMesh& mesh) {
  MeshOutline outline;
  const std::size_t triangles = mesh.indices.size() / 3;
  const std::size_t stride = 1 + triangles / max_triangles;
  for (std::size_t i = 0; i < triangles; i += stride) {
    const auto corner = [&](std::size_t k) { return position_of(mesh.vertices[mesh.indices[3 * i + k]]); };
    if (is_finite(corner(0)) && is_finite(corner(1)) && is_finite(corner(2))) {
      outline.insert(outline.end(), {corner(0), corner(1), corner(2)});
    }
  }
  return outline;
}

Vector3<double> PlacedOutline::seen(const Vector3<double>& position, double travel_time) const {
  if (!retarded) {
    return position;
  }
  const double angle = placement.rate * travel_time;
  const Vector3<double> then = std::cos(angle) * placement.position - std::sin(angle) * placement.ahead;
  return position + (then - placement.position);
}

std::vector<PlacedOutline> place_outlines(const std::vector<ObjectSettings>& objects,
                                          std::span<const MeshOutline> outlines, double time_s) {
  std::vector<PlacedOutline> placed;
  placed.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    PlacedOutline& outline = placed.emplace_back();
    outline.placement = placement_at(objects[i], time_s);
    outline.retarded = objects[i].retarded && outline.placement.rate != 0.0;
    outline.corners.reserve(outlines[i].size());
    const double(&rows)[3][3] = outline.placement.rows;
    for (const Vector3<double>& p : outlines[i]) {
      const auto row = [&](int k) { return rows[k][0] * p.x + rows[k][1] * p.y + rows[k][2] * p.z; };
      outline.corners.push_back(outline.placement.position + objects[i].size * Vector3<double>{row(0), row(1), row(2)});
    }
  }
  return placed;
}

Vector3<double> nearest_of_triangle(const Vector3<double>& point, std::span<const Vector3<double>, 3> corners) {
  const Vector3<double>& a = corners[0];
  const Vector3<double>& b = corners[1];
  const Vector3<double>& c = corners[2];
  const Vector3<double> normal = cross(b - a, c - a);
  const double square = dot(normal, normal);
  const auto is_within = [&](const Vector3<double>& from, const Vector3<double>& to) {
    return dot(cross(normal, to - from), point - from) >= 0.0;
  };
  if (square > 0.0 && is_within(a, b) && is_within(b, c) && is_within(c, a)) {
    return point - (dot(point - a, normal) / square) * normal;
  }
  const Vector3<double> sides[3] = {nearest_of_side(point, a, b), nearest_of_side(point, b, c),
                                    nearest_of_side(point, c, a)};
  return *std::ranges::min_element(sides, {}, [&](const Vector3<double>& at) { return dot(at - point, at - point); });
}

}  // namespace ergodome
