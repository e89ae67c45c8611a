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

//! Returns a mesh that draws these triangles. Triangles that form a complete grid, whose nodes are listed
//! row after row, become that grid, whichever way rows and columns run. Other triangles become a cell each,
//! which repeats the third corner as the fourth. Throws Error, naming `file`, if a triangle has a node that
//! does not exist, and if there are no triangles or too many.
WarpMesh warp_from_triangles(std::vector<WarpNode> nodes, const std::vector<WarpTriangle>& triangles,
                             const std::string& file);

//! Returns a rectangular mesh with its nodes reordered: rows from top to bottom, columns from left to right.
WarpMesh in_reading_order(WarpMesh mesh);

//! Returns the triangles of a strip, without those that have a node twice, which only join parts of it.
std::vector<WarpTriangle> triangles_of_strip(const std::vector<std::uint32_t>& indices);

}  // namespace ergodome
