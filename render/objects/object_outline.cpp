#include "render/objects/object_outline.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

constexpr std::size_t most_vertices = 16'384;

Vector3<double> position_of(const SurfaceVertex& vertex) {
  const float(&p)[3] = vertex.position;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace

MeshOutline outline_of(const TriangleMesh& mesh) {
  MeshOutline outline;
  if (mesh.vertices.empty()) {
    return outline;
  }
  const std::size_t stride = 1 + mesh.vertices.size() / most_vertices;
  constexpr int directions = 27;
  for (int direction = 0; direction < directions; ++direction) {
    const int x = direction % 3;
    const int y = direction / 3 % 3;
    const int z = direction / 9;
    const Vector3<double> n = {x - 1.0, y - 1.0, z - 1.0};
    if (dot(n, n) == 0.0) {
      continue;
    }
    Vector3<double> farthest = position_of(mesh.vertices.front());
    for (std::size_t i = stride; i < mesh.vertices.size(); i += stride) {
      const Vector3<double> place = position_of(mesh.vertices[i]);
      farthest = dot(place, n) > dot(farthest, n) ? place : farthest;
    }
    outline.push_back(farthest);
  }
  return outline;
}

Vector3<double> PlacedOutline::seen(const Vector3<double>& place, double travel_time) const {
  if (!retarded) {
    return place;
  }
  const double angle = placement.rate * travel_time;
  const Vector3<double> then = std::cos(angle) * placement.position - std::sin(angle) * placement.ahead;
  return place + (then - placement.position);
}

std::vector<PlacedOutline> place_outlines(const std::vector<ObjectSettings>& objects,
                                          std::span<const MeshOutline> outlines, double time_s) {
  std::vector<PlacedOutline> placed;
  placed.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    PlacedOutline& outline = placed.emplace_back();
    outline.placement = placement_at(objects[i], time_s);
    outline.retarded = objects[i].retarded && outline.placement.rate != 0.0;
    const double(&rows)[3][3] = outline.placement.rows;
    for (const Vector3<double>& p : outlines[i]) {
      const auto row = [&](int k) { return rows[k][0] * p.x + rows[k][1] * p.y + rows[k][2] * p.z; };
      outline.places.push_back(outline.placement.position + objects[i].size * Vector3<double>{row(0), row(1), row(2)});
    }
  }
  return placed;
}

}  // namespace ergodome
