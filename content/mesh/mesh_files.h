#pragma once

#include <filesystem>
#include <vector>

namespace ergodome {

//! Returns the files in the folder of a mesh, or below it, that it names: materials and images of
//! an OBJ, buffers and images of a glTF 2 file. Each appears once. Searches only the text, without
//! building the mesh, so some may be unused and the mesh may be invalid. Returns none if the mesh
//! cannot be read.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& mesh);

}  // namespace ergodome
