#pragma once

#include <cstddef>

namespace ergodome {

//! Limits of mesh files. What exceeds them is refused before memory is taken for it.
inline constexpr std::size_t largest_mesh_bytes = std::size_t{1} << 30U;
inline constexpr std::size_t most_mesh_triangles = 20'000'000;
inline constexpr std::size_t most_mesh_vertices = 3 * most_mesh_triangles;

//! Maximum light of a surface that only glows; display white is 1. More is cut off where objects are drawn.
inline constexpr float brightest_glow = 60'000.0F;

//! The remedy where a file is no mesh.
inline constexpr const char* wanted_meshes = "use a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb)";

}  // namespace ergodome
