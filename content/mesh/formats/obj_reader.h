#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Reads a Wavefront OBJ file (https://paulbourke.net/dataformats/obj/) from its text: faces of any
//! number of corners up to max_face_corners, texture coordinates, normals, smoothing groups, vertex
//! colors (sRGB, as Blender and MeshLab write them) and materials. Ignores lines, points, curves
//! and free-form surfaces. `folder` (may be empty) holds the files that it names. Throws Error if a
//! file that it names is missing and, with the line, if a face is malformed, names a missing
//! vertex, or has too many corners.
TriangleMesh read_obj(std::string_view text, const std::string& location, const std::filesystem::path& folder);

//! Returns the material libraries that an OBJ file names and the images that these name, if they
//! exist in its folder or below it; at most 1000.
std::vector<std::filesystem::path> files_of_obj(std::string_view text, const std::filesystem::path& folder);

}  // namespace ergodome
