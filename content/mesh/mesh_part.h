#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "kernels/core/error.h"

// What the importer of meshes has found, as far as it is drawn, and what of it is not.
namespace ergodome {

//! What is wrong where a mesh's file names one that is not in its folder.
Error missing_file(const std::string& place, const std::string& name);

//! Colour and image of one of the importer's meshes, without its triangles. Throws Error, with `place`, for images that are not there or could not be read.
MeshPart part_of(const aiScene& scene, const aiMesh& mesh, const std::string& place,
                 const std::filesystem::path& folder);

//! Remarks on what of a part is not drawn as its file has it.
void remark_on(const MeshPart& part, const aiMesh& from, TriangleMesh& mesh);

//! Remarks on materials that no file of an OBJ's has, of which it may name very many.
void remark_on_materials(std::vector<std::string> missing, TriangleMesh& mesh);

}  // namespace ergodome
