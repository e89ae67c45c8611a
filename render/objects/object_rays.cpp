#include "render/objects/object_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "content/objects/object_motion.h"
#include "render/objects/object_meshes.h"

namespace ergodome {

namespace {

constexpr int step_limit = 100'000;
constexpr int series_order = 16;
//! What is nearer to the horizon than this share of its radius is not looked for.
constexpr double beside_horizon = 1e-6;

}  // namespace

ObjectRays::ObjectRays(const Show& show, double time_s) : least_r_(std::numeric_limits<double>::max()) {
  const ObjectMeshes meshes = load_meshes(show);
  for (const TriangleMesh& mesh : meshes.meshes) {
    boxes_.push_back(build_triangle_tree(mesh));
  }
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    const ObjectPlacement at = placement_at(show.objects[i], time_s);
    PlacedMesh placed = {boxes_[meshes.mesh_of[i]].view(), at.position, {}, show.objects[i].size};
    std::copy(&at.rows[0][0], &at.rows[0][0] + 9, &placed.rows[0][0]);
    placed_.push_back(placed);
    const double distance = std::sqrt(dot(at.position, at.position));
    const double radius = placed.size * placed.tree.radius;
    least_r_ = std::min(least_r_, std::max(0.0, distance - radius));
    greatest_r_ = std::max(greatest_r_, distance + radius);
  }
}

std::optional<MeshHit> ObjectRays::look(const CameraStation& camera, const Vector3<double>& n, double tolerance) const {
  const double horizon = horizon_radius(camera.spin) * (1.0 + beside_horizon);
  const MeshScene scene = {placed_.data(), static_cast<int>(placed_.size()), std::max(least_r_, horizon),
                           std::max(greatest_r_, 1.01 * horizon)};
  MeshHit hit;
  const bool converged = trace_meshes<series_order, NearParts::azimuth_and_delay>(
      camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, n), scene, {tolerance, step_limit}, hit);
  return converged ? std::optional(hit) : std::nullopt;
}

std::uint32_t ObjectRays::triangle(const MeshHit& hit) const {
  return placed_[static_cast<std::size_t>(hit.mesh)].tree.triangles[hit.place];
}

}  // namespace ergodome
