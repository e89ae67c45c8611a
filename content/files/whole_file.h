#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace ergodome {

//! A file's bytes. Throws Error where it is missing, no regular file, cannot be read, or is larger than `most_bytes`, so that
//! nothing is allocated for a file that a format cannot have. `remedy` says what kind of file is wanted.
std::string read_whole_file(const std::filesystem::path& path, std::size_t most_bytes, const std::string& remedy);

}  // namespace ergodome
