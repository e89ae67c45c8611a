#include "render/diagram/apparent_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "content/show/object_settings.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"

namespace ergodome {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t whole_edge = 0xFFFFFFFFU;
//! Meshes with at least this many triangles are not divided further.
constexpr std::size_t max_divided_triangles = 1'000'000;

double length_of(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

//! Returns a number that identifies the edge between two corners, whatever their order.
std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

//! Halves those edges of a mesh that look curved.
class EdgeDivider {
 public:
  EdgeDivider(const Vector3<double>& observer, int order, double tolerance, ApparentMesh& mesh)
      : observer_(observer), order_(order), tolerance_(tolerance), mesh_(mesh) {}

  //! Divides each triangle that has a curved edge once, into two to four. Returns whether there was
  //! one.
  bool divide() {
    judge_new_edges();
    std::vector<Triangle> divided;
    divided.reserve(mesh_.triangles.size());
    for (const Triangle& triangle : mesh_.triangles) {
      divide(triangle, divided);
    }
    const bool changed = divided.size() != mesh_.triangles.size();
    mesh_.triangles = std::move(divided);
    return changed;
  }

 private:
  [[nodiscard]] std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) const { return middles_.at(edge_key(a, b)); }

  void judge_new_edges() {
    std::vector<std::array<std::uint32_t, 2>> fresh;
    for (const Triangle& t : mesh_.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i];
        const std::uint32_t b = t[(i + 1) % 3];
        if (middles_.emplace(edge_key(a, b), whole_edge).second) {
          fresh.push_back({a, b});
        }
      }
    }
    std::vector<std::optional<ApparentVertex>> middles(fresh.size());
    parallel_for(static_cast<int>(fresh.size()), 64, [&](int begin, int end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        middles[i] = bent_middle(mesh_.vertices[fresh[i][0]], mesh_.vertices[fresh[i][1]]);
      }
    });
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      if (middles[i]) {
        middles_[edge_key(fresh[i][0], fresh[i][1])] = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(*middles[i]);
      }
    }
  }

  //! Returns the vertex in the middle of an edge if the edge looks curved, or if light arrives from
  //! both ends but not from the middle; otherwise nothing.
  [[nodiscard]] std::optional<ApparentVertex> bent_middle(const ApparentVertex& a, const ApparentVertex& b) const {
    const ApparentVertex middle =
        apparent_vertex(observer_, 0.5 * (a.position + b.position), order_,
                        {0.5 * (a.texture[0] + b.texture[0]), 0.5 * (a.texture[1] + b.texture[1])});
    const bool bent = a.connected && b.connected &&
                      !(length_of(middle.seen - 0.5 * (a.seen + b.seen)) <= tolerance_ && middle.connected);
    return bent ? std::optional(middle) : std::nullopt;
  }

  void divide(const Triangle& t, std::vector<Triangle>& into) const {
    const std::array<std::uint32_t, 3> middle = {middle_of(t[0], t[1]), middle_of(t[1], t[2]), middle_of(t[2], t[0])};
    const auto bent = 3 - std::count(middle.begin(), middle.end(), whole_edge);
    if (bent == 0) {
      into.push_back(t);
    } else if (bent == 3) {
      into.push_back({t[0], middle[0], middle[2]});
      into.push_back({middle[0], t[1], middle[1]});
      into.push_back({middle[2], middle[1], t[2]});
      into.push_back({middle[0], middle[1], middle[2]});
    } else {
      divide_in_part(t, middle, bent == 1, into);
    }
  }

  //! Divides a triangle with exactly one curved edge, or with exactly one straight one.
  static void divide_in_part(const Triangle& t, const Triangle& middle, bool one_bent, std::vector<Triangle>& into) {
    std::size_t odd = 0;
    while ((middle[odd] != whole_edge) != one_bent) {
      ++odd;
    }
    const std::uint32_t a = t[odd];
    const std::uint32_t b = t[(odd + 1) % 3];
    const std::uint32_t c = t[(odd + 2) % 3];
    if (one_bent) {
      into.push_back({a, middle[odd], c});
      into.push_back({middle[odd], b, c});
      return;
    }
    const std::uint32_t beside_b = middle[(odd + 1) % 3];
    const std::uint32_t beside_a = middle[(odd + 2) % 3];
    into.push_back({a, b, beside_b});
    into.push_back({a, beside_b, beside_a});
    into.push_back({beside_a, beside_b, c});
  }

  Vector3<double> observer_;
  int order_;
  double tolerance_;
  ApparentMesh& mesh_;
  //! Index of the vertex in the middle of each edge, by edge_key(); whole_edge if the edge is not
  //! divided.
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

//! Returns whether the hole tears a triangle, by the same rule as the polygons' geometry shader
//! (render/passes/objects/polygons/object_shaders.cpp).
bool torn_by_hole(const Vector3<double>& observer, const std::array<const ApparentVertex*, 3>& corners, double torn) {
  const Vector3<double> outward = (1.0 / length_of(observer)) * observer;
  double around = 0.0;
  double around_flat = 0.0;
  double widest = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ApparentVertex& one = *corners[i];
    const ApparentVertex& other = *corners[(i + 1) % 3];
    around += length_of(one.direction - other.direction);
    const Vector3<double> flat = one.position - observer;
    const Vector3<double> other_flat = other.position - observer;
    around_flat += length_of((1.0 / length_of(flat)) * flat - (1.0 / length_of(other_flat)) * other_flat);
    const Vector3<double> across = one.direction - dot(outward, one.direction) * outward;
    const Vector3<double> other_across = other.direction - dot(outward, other.direction) * outward;
    widest = std::min(widest, dot(across, other_across) / std::max(length_of(across) * length_of(other_across), 1e-30));
  }
  return around > torn * around_flat && widest < 0.98;
}

void leave_out_torn(const Vector3<double>& observer, double torn, ApparentMesh& mesh) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const std::array<const ApparentVertex*, 3> corners = {&mesh.vertices[t[0]], &mesh.vertices[t[1]],
                                                          &mesh.vertices[t[2]]};
    return !std::ranges::all_of(corners, [](const ApparentVertex* v) { return v->connected; }) ||
           torn_by_hole(observer, corners, torn);
  });
}

}  // namespace

ApparentVertex apparent_vertex(const Vector3<double>& observer, const Vector3<double>& point, int order,
                               const std::array<double, 2>& texture) {
  const ConnectionPlane plane = connection_plane(observer, point);
  const double angle = image_angle(plane.phi, order);
  ApparentVertex vertex{point, point, {0.0, 0.0, 0.0}, texture, false};
  if (!(plane.r >= nearest_of_objects) || why_not_connected(plane.r_observer, plane.r, angle) != nullptr) {
    return vertex;
  }
  const ConnectingRay ray = connecting_ray(plane.r_observer, plane.r, angle);
  const ApparentPosition position = apparent_position(plane, order, ray.xi, ray.travel_time, ray.emission_angle);
  vertex.direction = position.direction;
  vertex.seen = observer + position.travel_time * position.direction;
  vertex.connected = true;
  return vertex;
}

Vector3<double> placed_point(const ObjectPlacement& placement, double size, const float (&position)[3]) {
  const Vector3<double> p = {static_cast<double>(position[0]), static_cast<double>(position[1]),
                             static_cast<double>(position[2])};
  const auto& rows = placement.rows;
  return placement.position + size * Vector3<double>{rows[0][0] * p.x + rows[0][1] * p.y + rows[0][2] * p.z,
                                                     rows[1][0] * p.x + rows[1][1] * p.y + rows[1][2] * p.z,
                                                     rows[2][0] * p.x + rows[2][1] * p.y + rows[2][2] * p.z};
}

ApparentMesh apparent_mesh(const Vector3<double>& observer, const TriangleMesh& mesh, const ObjectPlacement& placement,
                           double size, int order, const ApparentSettings& settings) {
  ApparentMesh apparent;
  apparent.vertices.resize(mesh.vertices.size());
  parallel_for(static_cast<int>(mesh.vertices.size()), 64, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const SurfaceVertex& from = mesh.vertices[i];
      apparent.vertices[i] =
          apparent_vertex(observer, placed_point(placement, size, from.position), order,
                          {static_cast<double>(from.texture[0]), static_cast<double>(from.texture[1])});
    }
  });
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    apparent.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  EdgeDivider divider(observer, order, settings.tolerance, apparent);
  for (int i = 0; i < settings.halvings && apparent.triangles.size() < max_divided_triangles && divider.divide(); ++i) {
  }
  leave_out_torn(observer, settings.torn, apparent);
  return apparent;
}

}  // namespace ergodome
