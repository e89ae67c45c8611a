#include "render/passes/objects/surface_store.h"

#include <algorithm>
#include <utility>

#include "kernels/launch/work_counter.h"
#include "render/passes/objects/object_meshes.h"

namespace ergodome {

namespace {

//! Maximum number of triangles of meshes whose trees are also kept in host memory, if the backend
//! is a GPU.
constexpr std::size_t max_kept_triangles = 1'000'000;

}  // namespace

SurfaceStore::SurfaceStore(const Show& show, Backend backend) {
  static WorkCounter counter("load_meshes");
  const WorkScope scope(counter, static_cast<long>(show.objects.size()));
  const ObjectMeshes loaded = load_meshes(show);
  in_horizon_ = objects_in_horizon(show, loaded);
  for (const TriangleMesh& mesh : loaded.meshes) {
    meshes_.push_back(store(mesh, backend));
  }
  for (const std::size_t index : loaded.mesh_of) {
    const Stored& mesh = meshes_[index];
    trees_.push_back({mesh.nodes.data(), mesh.corners.data(), mesh.triangles.data(), mesh.middle, mesh.radius});
    host_trees_.push_back(mesh.host_tree);
    outlines_.push_back(mesh.outline);
    surfaces_.push_back({mesh.vertices.data(), mesh.indices.data(), mesh.part_of.data(), mesh.parts.data()});
    triangle_count_ += loaded.meshes[index].triangle_count();
  }
}

SurfaceStore::Stored SurfaceStore::store(const TriangleMesh& mesh, Backend backend) {
  Stored stored;
  std::vector<SurfacePart> parts;
  std::vector<std::uint32_t> part_of(mesh.indices.size() / 3);
  for (const MeshPart& part : mesh.parts) {
    const auto from = part_of.begin() + static_cast<long>(part.first_index / 3);
    std::fill_n(from, part.index_count / 3, static_cast<std::uint32_t>(parts.size()));
    SurfacePart own = {
        {part.color[0], part.color[1], part.color[2]}, !part.image.empty(), part.wrap_u, part.wrap_v, {}};
    if (own.textured) {
      const OverlayImage image = read_mesh_image(part.image);
      stored.images.emplace_back(backend, image.texels, "meshes");
      own.image = image.view(stored.images.back().data());
    }
    parts.push_back(own);
  }
  TriangleBoxes boxes = build_triangle_tree(mesh);
  stored.nodes = {backend, boxes.nodes, "meshes"};
  stored.corners = {backend, boxes.corners, "meshes"};
  stored.triangles = {backend, boxes.triangles, "meshes"};
  stored.vertices = {backend, mesh.vertices, "meshes"};
  stored.indices = {backend, mesh.indices, "meshes"};
  stored.part_of = {backend, part_of, "meshes"};
  stored.parts = {backend, parts, "meshes"};
  stored.middle = boxes.middle;
  stored.radius = boxes.radius;
  stored.outline = outline_of(mesh);
  if (backend == Backend::cpu) {
    stored.host_tree = {stored.nodes.data(), stored.corners.data(), stored.triangles.data(), stored.middle,
                        stored.radius};
  } else if (boxes.triangles.size() <= max_kept_triangles) {
    stored.kept = std::move(boxes);
    stored.host_tree = stored.kept.view();
  }
  return stored;
}

}  // namespace ergodome
