#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! Finds the file in a mesh's folder, or below it, that a mesh names. Tries the name as written,
//! percent-decoded (RFC 3986, 2.1), with backslashes as separators, and as Latin-1; each also in
//! any case. Of an absolute path, only the file name counts. Returns an empty path if none exists
//! or `folder` is empty.
std::filesystem::path file_of_mesh(const std::filesystem::path& folder, const std::string& name);

//! Returns true if a relative name leads out of the mesh's folder ("../"); such files are not read.
//! False for absolute paths, of which only the file name is used.
bool leads_outside(const std::string& name);

}  // namespace ergodome
