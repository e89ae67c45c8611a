#pragma once

#include <cstddef>

namespace ergodome {

//! Limits of mesh files. Larger files are refused before memory is allocated for them.
inline constexpr std::size_t largest_mesh_bytes = std::size_t{1} << 30U;
inline constexpr std::size_t most_mesh_triangles = 20'000'000;
inline constexpr std::size_t most_mesh_vertices = 3 * most_mesh_triangles;

//! Maximum light of a surface that only emits; display white is 1. More is clamped.
inline constexpr float brightest_glow = 60'000.0F;

//! The remedy for files that are not meshes.
inline constexpr const char* wanted_meshes = "use a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb)";

}  // namespace ergodome
