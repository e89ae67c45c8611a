#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! Returns the file in a mesh's folder, or below it, that a mesh names: as written, as a URI (RFC 3986, 2.1), with backslashes,
//! or in another case of its letters; of an absolute path, the file of that name beside the mesh. Empty where there is none.
std::filesystem::path file_of_mesh(const std::filesystem::path& folder, const std::string& name);

//! Whether a name leads out of the mesh's folder, where nothing is read.
bool leads_outside(const std::string& name);

}  // namespace ergodome
