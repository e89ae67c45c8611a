#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! Finds the file in a mesh's folder, or below it, that a mesh names. Tries the name as written, as
//! a URI (RFC 3986, 2.1), with backslashes, and in any case; for an absolute path, the file with
//! that name beside the mesh. Returns an empty path if none exists.
std::filesystem::path file_of_mesh(const std::filesystem::path& folder, const std::string& name);

//! Returns true if a name leads out of the mesh's folder, where no files are read.
bool leads_outside(const std::string& name);

}  // namespace ergodome
