#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "content/mesh/formats/gltf_accessors.h"

namespace ergodome {

//! A mesh of the scene and the node that places it; -1 in a file without nodes.
struct GltfInstance {
  int node;
  int mesh;
};

//! The nodes of the file's default scene, or of its first scene, with their transforms. A file
//! without scenes shows all its nodes.
struct GltfNodes {
  std::vector<GltfInstance> instances;
  std::vector<glm::dmat4> world;  //!< for each node, the matrix from its coordinates to the scene's
};

//! Traverses the nodes of the scene. Nodes hidden by KHR_node_visibility and their children place
//! no meshes. Throws Error if a node has two parents: the format forbids it, and a few such nodes
//! could expand to billions.
GltfNodes gltf_nodes(const GltfFile& file);

}  // namespace ergodome
