#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! The path of a file that a mesh in a folder names; empty where it is not there, or not in the folder or below. glTF names files by URIs: a name that is
//! not there is tried as one, where "%20" stands for a blank.
std::filesystem::path file_of_mesh(const std::filesystem::path& folder, const std::string& name);

}  // namespace ergodome
