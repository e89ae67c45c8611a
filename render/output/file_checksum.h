#pragma once

#include <filesystem>

namespace ergodome {

//! Appends a checksum of all bytes before it (XXH3, 64 bits) to an image file. PNG has its own
//! checksums; TIFF has none, and EXR has them only with some compressions. Readers of both use
//! offsets within the file and ignore what follows the image. Throws Error if the file cannot be
//! read or written.
void append_checksum(const std::filesystem::path& file);

//! Returns whether a file ends with the correct checksum of its bytes.
bool has_right_checksum(const std::filesystem::path& file);

}  // namespace ergodome
