#include "render/diagram/diagram_scene.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

Ink display_ink(unsigned rgb) {
  const auto linear = [](unsigned byte) {
    const double v = (byte & 0xFFU) / 255.0;
    return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  };
  return {linear(rgb >> 16U), linear(rgb >> 8U), linear(rgb)};
}

namespace diagram_inks {
Ink of_image(int order) {
  constexpr unsigned inks[] = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0x8C6D1F};
  return display_ink(inks[std::clamp(order, 1, 5) - 1]);
}
Ink pale(const Ink& ink) {
  const Ink on = paper();
  return {0.45F * ink[0] + 0.55F * on[0], 0.45F * ink[1] + 0.55F * on[1], 0.45F * ink[2] + 0.55F * on[2]};
}
Ink paper() { return display_ink(0xF7F6F3); }
Ink hole() { return display_ink(0x000000); }
Ink grid() { return display_ink(0xDDDCD8); }
Ink axis() { return display_ink(0xA9A8A4); }
Ink words() { return display_ink(0x2B2B2B); }
Ink observer() { return display_ink(0x3D3D3D); }
Ink photon_sphere() { return display_ink(0x6E6E6E); }
Ink other_rays() { return display_ink(0x9A9EA8); }
}  // namespace diagram_inks

void add_ball(std::vector<DiagramCorner>& corners, const Vector3<double>& middle, double radius, const Ink& ink) {
  constexpr int segments = 64;
  constexpr int rings = 32;
  const auto corner = [&](int ring, int segment) {
    const double theta = pi * ring / rings;
    const double phi = full_turn * segment / segments;
    const Vector3<double> n = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    return DiagramCorner{middle + radius * n,
                         {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                         {ink[0], ink[1], ink[2], 1.0F}};
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      corners.insert(corners.end(), {corner(ring, segment), corner(ring + 1, segment), corner(ring + 1, segment + 1)});
      corners.insert(corners.end(), {corner(ring, segment), corner(ring + 1, segment + 1), corner(ring, segment + 1)});
    }
  }
}

std::vector<Vector3<double>> level_circle(double radius, double height) {
  constexpr int sides = 180;
  std::vector<Vector3<double>> circle;
  circle.reserve(sides + 1);
  for (int i = 0; i <= sides; ++i) {
    const double angle = full_turn * i / sides;
    circle.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
  }
  return circle;
}

namespace {

//! Opacity of translucent meshes (veils).
constexpr float veil_cover = 0.6F;
//! Minimum light factor of the dark checkerboard fields of translucent meshes, so that these keep
//! their color there.
constexpr double min_veil_dark = 0.55;

Vector3<float> in_floats(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::array<float, 3> checker_at(const ObjectSettings& object, double u, double v, double min_dark) {
  if (!object.checker) {
    return {0.0F, 0.0F, 1.0F};
  }
  return {static_cast<float>(u * object.checker->columns), static_cast<float>(v * object.checker->rows),
          static_cast<float>(std::max(object.checker->dark, min_dark))};
}

Vector3<double> turned_normal(const ObjectPlacement& placement, const SurfaceVertex& vertex) {
  return placed_point({{0.0, 0.0, 0.0},
                       {{placement.rows[0][0], placement.rows[0][1], placement.rows[0][2]},
                        {placement.rows[1][0], placement.rows[1][1], placement.rows[1][2]},
                        {placement.rows[2][0], placement.rows[2][1], placement.rows[2][2]}}},
                      1.0, vertex.normal);
}

DiagramCorner diagram_corner_of(const ObjectSettings& object, const ObjectPlacement& placement,
                                const SurfaceVertex& vertex, double min_dark) {
  return {placed_point(placement, object.size, vertex.position),
          in_floats(turned_normal(placement, vertex)),
          {},
          checker_at(object, static_cast<double>(vertex.texture[0]), static_cast<double>(vertex.texture[1]), min_dark)};
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
                         checker_at(object, vertex.texture[0], vertex.texture[1], min_veil_dark)});
    }
  }
}

void add_veil(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement, const Ink& ink,
              std::vector<DiagramCorner>& corners) {
  for (const std::uint32_t index : mesh.indices) {
    DiagramCorner corner = diagram_corner_of(object, placement, mesh.vertices[index], min_veil_dark);
    corner.color = {ink[0], ink[1], ink[2], veil_cover};
    corners.push_back(corner);
  }
}

}  // namespace ergodome
