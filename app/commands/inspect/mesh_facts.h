#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/show/show.h"

namespace ergodome {

//! A summary of a mesh file, in the file's units.
struct MeshFacts {
  std::string file;  //!< as named in the show
  long triangles = 0;
  long dropped_triangles = 0;
  Vector3<double> extent;  //!< size along the mesh's axes
  std::vector<std::string> remarks;
};

//! Summarizes a mesh. Reads its textures as frames do; throws Error if one cannot be read.
MeshFacts facts_of_mesh(const std::string& file, const TriangleMesh& mesh);

//! Returns the meshes of a show's objects, each scaled to M by the object's size.
nlohmann::json facts_of_meshes(const Show& show, const std::vector<MeshFacts>& meshes);

void print_meshes(const nlohmann::json& facts);

}  // namespace ergodome
