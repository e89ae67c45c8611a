#pragma once

#include <filesystem>
#include <string_view>

#include "content/mesh/mesh_limits.h"
#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Kinds of mesh files that are read.
enum class MeshFormat { obj, gltf, glb };

//! Reads a mesh from a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb), with its materials and what else it names beside it,
//! but nothing outside its folder. Triangles without area are dropped.
//!
//! Throws Error, with the file and a remedy, where it or a file that it names is missing, of another kind, malformed, too large,
//! or has no triangle, or one with a non-finite corner.
TriangleMesh read_mesh(const std::filesystem::path& path);

//! The same from bytes that name files in `folder`; where it is empty, these are not there. `place` is how messages call the
//! mesh.
TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& place,
                        const std::filesystem::path& folder = {});

}  // namespace ergodome
