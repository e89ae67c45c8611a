#include "render/passes/objects/object_rays.h"

#include "render/passes/objects/object_meshes.h"

namespace ergodome {

namespace {

constexpr int object_step_limit = 100'000;
constexpr int series_order = 16;

}  // namespace

ObjectRays::ObjectRays(const Show& show, double time_s) {
  const ObjectMeshes meshes = load_meshes(show);
  for (const TriangleMesh& mesh : meshes.meshes) {
    boxes_.push_back(build_triangle_tree(mesh));
  }
  std::vector<TriangleTree> trees;
  trees.reserve(meshes.mesh_of.size());
  for (const std::size_t mesh : meshes.mesh_of) {
    trees.push_back(boxes_[mesh].view());
  }
  placed_ = place_meshes(show.objects, trees, time_s);
}

std::optional<MeshHit> ObjectRays::first_hit(const CameraStation& camera, const Vector3<double>& n,
                                             double tolerance) const {
  MeshHit hit;
  const bool converged = trace_meshes<series_order, NearParts::azimuth_and_delay>(
      camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, n),
      placed_.around(spacetime_of(camera), placed_.meshes.data()), {tolerance, object_step_limit}, hit);
  return converged ? std::optional(hit) : std::nullopt;
}

std::uint32_t ObjectRays::triangle(const MeshHit& hit) const {
  return placed_.meshes[static_cast<std::size_t>(hit.mesh)].tree.triangles[hit.tree_index];
}

}  // namespace ergodome
