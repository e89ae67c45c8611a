#pragma once

#include <string>
#include <string_view>

#include "content/mesh/mesh_reader.h"

namespace ergodome {

//! What is asked for in place of a file that is no mesh.
constexpr const char* wanted_meshes = "give a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb)";

//! Throws Error, by the name `place`, where the bytes of a mesh are torn and the importer would not say so.
void require_whole_mesh(std::string_view bytes, MeshFormat format, const std::string& place);

}  // namespace ergodome
