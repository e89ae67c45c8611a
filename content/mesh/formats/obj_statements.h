#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "content/mesh/formats/obj_materials.h"
#include "content/mesh/mesh_builder.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! Indices of a face's corner, from 0; -1 for none.
struct ObjCorner {
  std::int64_t vertex;
  std::int64_t texture;
  std::int64_t normal;
};

inline constexpr int no_obj_material = -1;

//! A polygon; its corners are consecutive.
struct ObjFace {
  std::size_t first_corner;
  std::uint32_t corners;
  int material;          //!< index in ObjStatements::names, or no_obj_material
  long smoothing_group;  //!< number of the smoothing group; 0: flat
  long line;
};

struct ObjVertex {
  Vector3<double> position;
  std::array<float, 3> color;  //!< linear light
  bool has_color;
};

//! The statements of an OBJ file and of the material files that it names.
struct ObjStatements {
  std::vector<ObjVertex> vertices;
  std::vector<std::array<float, 2>> textures;
  std::vector<Vector3<double>> normals;
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  ObjMaterials materials;
  std::vector<std::string> names;  //!< names of the materials that faces use
  bool has_colors = false;
  bool has_lines = false;
  bool has_free_forms = false;
};

//! Maximum size of a material file, which has only some lines per material.
inline constexpr std::size_t largest_obj_library_bytes = std::size_t{64} << 20U;
inline constexpr const char* obj_library_remedy = "a material file is a short text file; check the path";

//! Reads the statements of a file. Calls MeshBuilder::reserve() for their triangles; `builder` has
//! the name of the file in messages. `folder` holds its material files; empty: none are read. In
//! the result, all indices of faces exist, and the positions of their vertices are finite. Throws
//! Error with the line if the file violates this, if a statement is malformed, or if the file is
//! too large or truncated in a face.
ObjStatements read_obj_statements(std::string_view text, const std::filesystem::path& folder, MeshBuilder& builder);

}  // namespace ergodome
