#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "calibration/warp_mesh.h"

// Warps that files describe as triangles, as the grid that warp_mesh.h has.
namespace ergodome {

//! Numbers of three nodes.
using WarpTriangle = std::array<std::uint32_t, 3>;

//! Returns a mesh that draws these triangles. Nodes that lie row after row and make a full grid of cells become that grid, whichever
//! way rows and columns run. Other triangles become a cell each, the fourth corner being the third once more. Throws Error, naming
//! `file`, where a triangle has a node that does not exist, and where there are no triangles or too many.
WarpMesh warp_from_triangles(std::vector<WarpNode> nodes, const std::vector<WarpTriangle>& triangles,
                             const std::string& file);

//! Returns a rectangular grid of nodes with rows from top to bottom and columns from left to right.
WarpMesh in_reading_order(WarpMesh mesh);

//! Returns the triangles of a strip; those with a node twice, which join parts of the strip, are left out.
std::vector<WarpTriangle> triangles_of_strip(const std::vector<std::uint32_t>& indices);

}  // namespace ergodome
