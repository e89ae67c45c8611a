#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibration/warps/warp_mesh.h"

// Paul Bourke's mesh files (http://paulbourke.net/dataformats/meshwarp/), in ASCII. Line 1: type, 2 rectangular or 1 polar; line
// 2: columns and rows; then a line "x y u v i" for each node, columns fastest: the place on the output, the place in the source
// image, and a factor of its values. x runs from -aspect to aspect across the raster, y from -1 at the bottom to 1 at the top; u
// and v from 0 to 1, v upwards. A node of negative intensity is not drawn. Lines may end in any way, and blank ones may stand
// between.
namespace ergodome {

//! Reads a mesh. `half_width` is what x is at the right side of the raster: its width over its height as the format has it, or 1
//! where a program wrote x from -1 to 1. Rows of a rectangular mesh come out from top to bottom whichever way they stand in the
//! file. Columns of a polar mesh go round (the format says only that such a mesh closes at 360°).
//!
//! Throws Error with the line for words that are no finite numbers, lines of another length, sizes below 2 or above the bounds of
//! warp_mesh.h, more or fewer nodes than announced, and meshes without a node to draw.
WarpMesh parse_bourke_mesh(std::string_view text, const std::string& file, double half_width);

//! The same from a file.
WarpMesh read_bourke_mesh(const std::filesystem::path& path, double half_width);

//! A mesh as text that parse_bourke_mesh reads back to the same nodes but for the rounding of float; rows from bottom to top.
std::string to_bourke_mesh(const WarpMesh& mesh, double half_width);

}  // namespace ergodome
