#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! Materials that an OBJ uses and none of its libraries in the folder has, each once; the importer makes a grey one of each, and says nothing.
std::vector<std::string> missing_materials(std::string_view obj, const std::filesystem::path& folder);

}  // namespace ergodome
