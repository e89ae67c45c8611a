#pragma once

#include <filesystem>
#include <vector>

namespace ergodome {

//! Files in the folder of a mesh, or below, that it names: materials of an OBJ with their pictures, buffers and pictures of a glTF 2 file. By its text
//! alone, without making a mesh of it: so some may be among them that its triangles do not need, and it may be no mesh at all. Each once; none where it cannot
//! be read.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& mesh);

}  // namespace ergodome
