#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Reads a Wavefront OBJ file (https://paulbourke.net/dataformats/obj/) from its text: faces of any number of corners, their
//! texture coordinates, normals, smoothing groups, colours of vertices (sRGB, as Blender and MeshLab write them) and
//! materials. Lines, points, curves and surfaces are left out. `folder` holds the files that it names; empty: there are none.
//! Throws Error, with the line, where a face is malformed, names a vertex that is not there, or has too many corners.
TriangleMesh read_obj(std::string_view text, const std::string& place, const std::filesystem::path& folder);

//! Returns the material libraries and pictures that an OBJ file names and that are in its folder.
std::vector<std::filesystem::path> files_of_obj(std::string_view text, const std::filesystem::path& folder);

}  // namespace ergodome
