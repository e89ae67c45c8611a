#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/show/show.h"

namespace ergodome {

//! What is to be known of a mesh's file, in a unit of its own.
struct MeshFacts {
  std::string file;  //!< as the show names it
  long triangles = 0;
  long dropped_triangles = 0;
  Vector3<double> extent;  //!< along its own axes
  std::vector<std::string> remarks;
};

//! Reads the pictures on a mesh, too, as frames do; throws Error where one cannot be read.
MeshFacts facts_of_mesh(const std::string& file, const TriangleMesh& mesh);

//! Those of a show's objects, each in M by the object's size.
nlohmann::json facts_of_meshes(const Show& show, const std::vector<MeshFacts>& meshes);

void print_meshes(const nlohmann::json& facts);

}  // namespace ergodome
