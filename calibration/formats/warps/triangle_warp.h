#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "calibration/warps/warp_mesh.h"

// Converts warps that files describe as triangles to the grid of warp_mesh.h.
namespace ergodome {

//! Indices of three nodes.
using WarpTriangle = std::array<std::uint32_t, 3>;

//! Returns a mesh that draws these triangles. If they form a complete grid whose nodes are listed
//! row by row, returns that grid, whatever the directions of rows and columns. Otherwise each
//! triangle becomes a cell that repeats the third corner as the fourth. Throws Error, which names
//! `file`, if a triangle refers to a missing node, or if there are no triangles or too many.
WarpMesh warp_from_triangles(std::vector<WarpNode> nodes, const std::vector<WarpTriangle>& triangles,
                             const std::string& file);

//! Returns a rectangular mesh with its nodes reordered: rows from top to bottom, columns from left
//! to right.
WarpMesh in_reading_order(WarpMesh mesh);

//! Returns the triangles of a strip, without the degenerate ones that only join its parts.
std::vector<WarpTriangle> triangles_of_strip(const std::vector<std::uint32_t>& indices);

}  // namespace ergodome
