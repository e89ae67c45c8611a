#pragma once

#include <filesystem>
#include <string_view>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Sizes that meshes may have: what is larger is refused before anything is made of it.
inline constexpr std::size_t largest_mesh_bytes = std::size_t{1} << 30U;
inline constexpr std::size_t most_mesh_triangles = 20'000'000;

//! Kinds of mesh files that are read.
enum class MeshFormat { obj, gltf, glb };

//! Reads a mesh from a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb), with its materials and what else it names beside it, but nothing
//! outside its folder. Faces become triangles, missing normals smooth ones; nodes stand where the file places them, lines, points, cameras
//! and animations are left out. Triangles without area are dropped.
//!
//! Throws Error, with the file and a remedy, where it or a file that it names is missing, of another kind, torn, too large, has no
//! triangle, or one with a corner that is no number.
TriangleMesh read_mesh(const std::filesystem::path& path);

//! The same of bytes that name files in `folder`; where it is empty, these are not there. `place` is how messages call the mesh.
TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& place,
                        const std::filesystem::path& folder = {});

}  // namespace ergodome
