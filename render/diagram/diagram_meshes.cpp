#include "render/diagram/diagram_meshes.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Opacity of a veil.
constexpr float veil_cover = 0.6F;
//! Veils keep their color in the dark fields of their checkerboard.
constexpr double least_veil_dark = 0.55;

Vector3<float> in_floats(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::array<float, 3> checker_at(const ObjectSettings& object, double u, double v, double least_dark) {
  if (!object.checker) {
    return {0.0F, 0.0F, 1.0F};
  }
  return {static_cast<float>(u * object.checker->columns), static_cast<float>(v * object.checker->rows),
          static_cast<float>(std::max(object.checker->dark, least_dark))};
}

Vector3<double> turned_normal(const ObjectPlacement& placement, const SurfaceVertex& vertex) {
  return placed_point({{0.0, 0.0, 0.0},
                       {{placement.rows[0][0], placement.rows[0][1], placement.rows[0][2]},
                        {placement.rows[1][0], placement.rows[1][1], placement.rows[1][2]},
                        {placement.rows[2][0], placement.rows[2][1], placement.rows[2][2]}}},
                      1.0, vertex.normal);
}

DiagramCorner diagram_corner_of(const ObjectSettings& object, const ObjectPlacement& placement,
                                const SurfaceVertex& vertex, double least_dark) {
  return {
      placed_point(placement, object.size, vertex.position),
      in_floats(turned_normal(placement, vertex)),
      {},
      checker_at(object, static_cast<double>(vertex.texture[0]), static_cast<double>(vertex.texture[1]), least_dark)};
}

//! Returns the normals of a mesh's corners, averaged over the adjacent triangles by their areas.
std::vector<Vector3<double>> smooth_normals(const ApparentMesh& mesh) {
  std::vector<Vector3<double>> normals(mesh.vertices.size(), {0.0, 0.0, 0.0});
  for (const auto& t : mesh.triangles) {
    const Vector3<double>& a = mesh.vertices[t[0]].seen;
    const Vector3<double> normal = cross(mesh.vertices[t[1]].seen - a, mesh.vertices[t[2]].seen - a);
    for (const std::uint32_t corner : t) {
      normals[corner] = normals[corner] + normal;
    }
  }
  for (Vector3<double>& normal : normals) {
    const double length = std::sqrt(dot(normal, normal));
    normal = length > 0.0 ? (1.0 / length) * normal : Vector3<double>{0.0, 0.0, 1.0};
  }
  return normals;
}

}  // namespace

void add_solid(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement,
               std::vector<DiagramCorner>& corners) {
  for (const MeshPart& part : mesh.parts) {
    const double own[3] = {object.color.x, object.color.y, object.color.z};
    std::array<float, 4> color = {0.0F, 0.0F, 0.0F, 1.0F};
    for (std::size_t k = 0; k < 3; ++k) {
      color[k] = std::clamp(static_cast<float>(object.exposure * own[k]) * part.color[k], 0.0F, 1.0F);
    }
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      DiagramCorner corner = diagram_corner_of(object, placement, mesh.vertices[mesh.indices[i]], 0.0);
      corner.color = color;
      corners.push_back(corner);
    }
  }
}

void add_veil(const ObjectSettings& object, const ApparentMesh& mesh, const Ink& ink,
              std::vector<DiagramCorner>& corners) {
  const std::vector<Vector3<double>> normals = smooth_normals(mesh);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t i : t) {
      const ApparentVertex& vertex = mesh.vertices[i];
      corners.push_back({vertex.seen,
                         in_floats(normals[i]),
                         {ink[0], ink[1], ink[2], veil_cover},
                         checker_at(object, vertex.texture[0], vertex.texture[1], least_veil_dark)});
    }
  }
}

void add_veil(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement, const Ink& ink,
              std::vector<DiagramCorner>& corners) {
  for (const std::uint32_t index : mesh.indices) {
    DiagramCorner corner = diagram_corner_of(object, placement, mesh.vertices[index], least_veil_dark);
    corner.color = {ink[0], ink[1], ink[2], veil_cover};
    corners.push_back(corner);
  }
}

}  // namespace ergodome
