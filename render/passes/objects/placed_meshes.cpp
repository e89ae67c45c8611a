#include "render/passes/objects/placed_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Parts closer to the horizon than this fraction of its radius are ignored.
constexpr double beside_horizon = 1e-6;

}  // namespace

MeshScene PlacedMeshes::around(Spacetime spacetime, const PlacedMesh* at) const {
  const double horizon = horizon_radius(spacetime) * (1.0 + beside_horizon);
  return {at, static_cast<int>(meshes.size()), std::max(min_r, horizon), std::max(max_r, 1.01 * horizon)};
}

PlacedMeshes place_meshes(const std::vector<ObjectSettings>& objects, std::span<const TriangleTree> trees,
                          double time_s) {
  PlacedMeshes placed = {{}, std::numeric_limits<double>::max(), 0.0};
  placed.meshes.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObjectPlacement at = placement_at(objects[i], time_s);
    PlacedMesh mesh = {trees[i],
                       at.position,
                       {},
                       objects[i].size,
                       {at.position, at.ahead, at.rate},
                       objects[i].retarded && at.rate != 0.0};
    std::copy(&at.rows[0][0], &at.rows[0][0] + 9, &mesh.rows[0][0]);
    placed.meshes.push_back(mesh);
    // A retarded object is seen at several positions on its orbit. The object's origin keeps its
    // distance from the hole, but the center of its bounding sphere need not.
    const Vector3<double> middle = mesh.retarded ? at.position : ball_middle(mesh, at.position);
    const double beside = mesh.retarded ? std::sqrt(dot(mesh.tree.middle, mesh.tree.middle)) : 0.0;
    const double distance = std::sqrt(dot(middle, middle));
    const double radius = mesh.size * (mesh.tree.radius + beside);
    placed.min_r = std::min(placed.min_r, std::max(0.0, distance - radius));
    placed.max_r = std::max(placed.max_r, distance + radius);
  }
  return placed;
}

}  // namespace ergodome
