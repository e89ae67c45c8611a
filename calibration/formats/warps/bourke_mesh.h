#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibration/warps/warp_mesh.h"

// Paul Bourke's mesh files (http://paulbourke.net/dataformats/meshwarp/), in ASCII. Line 1: type, 2
// rectangular or 1 polar. Line 2: columns and rows. Then a line "x y u v i" for each node, columns
// fastest: the position on the output, the position in the source image, and a factor of its
// values. x runs from -aspect to aspect across the raster, y from -1 at the bottom to 1 at the top.
// u and v run from 0 to 1, v upward. Nodes of negative intensity are not drawn. Line ends of any
// kind and blank lines are accepted.
namespace ergodome {

//! Reads a mesh. `half_width` is x at the right side of the raster: the raster's aspect ratio
//! according to the format, or 1 if a program wrote x from -1 to 1. Rows of a rectangular mesh are
//! returned from top to bottom, whatever their order in the file. Columns of a polar mesh go around
//! (the format states only that such a mesh closes at 360°).
//!
//! Throws Error with the line for words that are not finite numbers, lines of another length, sizes
//! below 2 or above the limits of warp_mesh.h, a number of nodes that differs from the header, and
//! meshes without a node to draw.
WarpMesh parse_bourke_mesh(std::string_view text, const std::string& file, double half_width);

//! Reads a mesh from a file.
WarpMesh read_bourke_mesh(const std::filesystem::path& path, double half_width);

//! Returns a mesh as text from which parse_bourke_mesh() reads the same nodes, except for rounding
//! to float; rows from bottom to top.
std::string to_bourke_mesh(const WarpMesh& mesh, double half_width);

}  // namespace ergodome
