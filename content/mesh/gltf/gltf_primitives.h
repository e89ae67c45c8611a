#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "content/mesh/gltf/gltf_accessors.h"
#include "content/mesh/mesh_builder.h"

namespace ergodome {

//! Where a primitive stands: by one matrix, or by those of the joints of a skin.
struct GltfPlacement {
  glm::dmat4 world;
  std::vector<glm::dmat4> joints;      //!< of a skin; empty: it has none
  const std::vector<double>* weights;  //!< of its morph targets
};

//! Adds the triangles of a primitive to a mesh. Points and lines add nothing.
void add_gltf_primitive(const GltfFile& file, const tinygltf::Primitive& primitive, const GltfPlacement& placement,
                        MeshBuilder& builder);

}  // namespace ergodome
