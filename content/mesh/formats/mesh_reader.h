#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "content/mesh/mesh_builder.h"
#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Supported kinds of mesh files.
enum class MeshFormat { obj, gltf, glb };

//! Reads a mesh from a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb), with its materials and
//! the files that it names in its folder, but none outside. Drops triangles without area.
//!
//! Throws Error, with the file and a remedy, if the mesh or a file that it names is missing, of an
//! unsupported kind, malformed or too large, and if it has no triangles or a non-finite corner.
TriangleMesh read_mesh(const std::filesystem::path& path);

//! Reads a mesh from bytes as read_mesh() does. `folder` (may be empty) holds the files that it
//! names. `location` is the name of the mesh in messages.
TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& location,
                        const std::filesystem::path& folder = {});

//! Returns the files in the folder of a mesh, or below it, that it names: materials and images of
//! an OBJ, buffers and images of a glTF 2 file. Each appears once. Searches only the text, without
//! building the mesh, so some may be unused and the mesh may be invalid. Returns none if the mesh
//! cannot be read.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& mesh);

}  // namespace ergodome
