#include "content/mesh/built_in_meshes.h"

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

SurfaceVertex vertex_of(const Vector3<double>& position, const Vector3<double>& normal, double u, double v) {
  return {{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)},
          {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)},
          {static_cast<float>(u), static_cast<float>(v)},
          {1.0F, 1.0F, 1.0F}};
}

//! Adds a grid of (columns + 1) x (rows + 1) vertices with two triangles per cell; `point(u, v)`
//! returns a vertex. As seen from outside the surface, the direction of increasing v must be
//! counterclockwise from that of increasing u.
template <class Point>
void add_grid(TriangleMesh& mesh, int columns, int rows, const Point& point) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      mesh.vertices.push_back(point(static_cast<double>(column) / columns, static_cast<double>(row) / rows));
    }
  }
  const auto at = [&](int column, int row) { return first + static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t corner[4] = {at(column, row), at(column + 1, row), at(column + 1, row + 1),
                                       at(column, row + 1)};
      mesh.indices.insert(mesh.indices.end(), {corner[0], corner[1], corner[2], corner[0], corner[2], corner[3]});
    }
  }
}

//! Adds a part with all indices since the previous part.
void end_part(TriangleMesh& mesh, const std::array<float, 3>& color) {
  const std::uint32_t first = mesh.parts.empty() ? 0 : mesh.parts.back().first_index + mesh.parts.back().index_count;
  MeshPart& part = mesh.parts.emplace_back();
  part.first_index = first;
  part.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - first;
  part.color = color;
}

Vector3<double> round_axis(double u) { return {std::cos(2.0 * pi * u), std::sin(2.0 * pi * u), 0.0}; }

}  // namespace

TriangleMesh make_triangle(const TriangleShape& shape) {
  const Vector3<double> normal = cross(shape.corners[1] - shape.corners[0], shape.corners[2] - shape.corners[0]);
  const double length = std::sqrt(dot(normal, normal));
  TriangleMesh mesh;
  for (int i = 0; i < 3; ++i) {
    mesh.vertices.push_back(vertex_of(shape.corners[static_cast<std::size_t>(i)], (1.0 / length) * normal,
                                      i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0));
  }
  mesh.indices = {0, 1, 2};
  end_part(mesh, {1.0F, 1.0F, 1.0F});
  drop_degenerate_triangles(mesh);
  if (mesh.indices.empty()) {
    throw Error("triangle", "has its three corners on one line", "move one of them off the line");
  }
  return mesh;
}

TriangleMesh make_sphere(const SphereShape& shape) {
  TriangleMesh mesh;
  add_grid(mesh, shape.segments, shape.rings, [](double u, double v) {
    const double south = pi * v;  // from the south pole
    const Vector3<double> position = std::sin(south) * round_axis(u) + Vector3<double>{0.0, 0.0, -std::cos(south)};
    return vertex_of(position, position, u, v);
  });
  end_part(mesh, {1.0F, 1.0F, 1.0F});
  // In cells that touch a pole, one of the two triangles has no area.
  drop_degenerate_triangles(mesh);
  mesh.dropped_triangles = 0;
  return mesh;
}

TriangleMesh make_disk(const DiskShape& shape) {
  TriangleMesh mesh;
  const double half = 0.5 * shape.thickness;
  const auto radius = [&](double v) { return shape.inner + v * (shape.outer - shape.inner); };
  const auto across = [&](double v) { return Vector3<double>{0.0, 0.0, half * (2.0 * v - 1.0)}; };
  const auto face = [&](double side) {
    return [half, radius, side](double u, double v) {
      // As seen from outside, v must increase counterclockwise from u (add_grid()): inward on the
      // face toward +z, outward on the one toward -z.
      const double out = side > 0.0 ? 1.0 - v : v;
      return vertex_of(radius(out) * round_axis(u) + Vector3<double>{0.0, 0.0, side * half}, {0.0, 0.0, side}, u, out);
    };
  };
  add_grid(mesh, shape.segments, shape.rings, face(1.0));
  end_part(mesh, {0.8F, 0.08F, 0.04F});
  add_grid(mesh, shape.segments, shape.rings, face(-1.0));
  end_part(mesh, {0.05F, 0.12F, 0.8F});
  add_grid(mesh, shape.segments, 1,
           [&](double u, double v) { return vertex_of(shape.outer * round_axis(u) + across(v), round_axis(u), u, v); });
  add_grid(mesh, shape.segments, 1, [&](double u, double v) {
    return vertex_of(shape.inner * round_axis(u) + across(1.0 - v), -1.0 * round_axis(u), u, 1.0 - v);
  });
  end_part(mesh, {0.1F, 0.6F, 0.12F});
  return mesh;
}

}  // namespace ergodome
