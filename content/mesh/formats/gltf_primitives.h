#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "content/mesh/formats/gltf_accessors.h"
#include "content/mesh/mesh_builder.h"

namespace ergodome {

//! The transform of a primitive: one matrix, or those of the joints of a skin.
struct GltfPlacement {
  glm::dmat4 world;
  std::vector<glm::dmat4> joints;      //!< matrices of the joints of a skin; empty without a skin
  const std::vector<double>* weights;  //!< weights of the morph targets; null: no morphing
};

//! Adds the triangles of a primitive to a mesh, and remarks on what is drawn differently or not at
//! all, such as points and lines.
void add_gltf_primitive(const GltfFile& file, const tinygltf::Primitive& primitive, const GltfPlacement& placement,
                        MeshBuilder& builder);

}  // namespace ergodome
