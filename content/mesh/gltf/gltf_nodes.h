#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "content/mesh/gltf/gltf_accessors.h"

namespace ergodome {

//! A node of the scene that has a mesh.
struct GltfInstance {
  int node;
  int mesh;
};

//! The nodes of the file's default scene, or of its first, where they stand. A file without scenes shows all its nodes.
struct GltfNodes {
  std::vector<GltfInstance> instances;
  std::vector<glm::dmat4> world;  //!< of each node: from its own space to the scene's
};

//! Walks through the nodes; those that KHR_node_visibility hides place no meshes, nor do their children. Throws Error where a node has two parents, as the format forbids: a few nodes could stand for
//! billions.
GltfNodes gltf_nodes(const GltfFile& file);

}  // namespace ergodome
