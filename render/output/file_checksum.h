#pragma once

#include <filesystem>

namespace ergodome {

//! Appends a checksum of all bytes before it (XXH3, 64 bits) to an image file. PNG has checksums of its own; TIFF has none, and
//! EXR only in some compressions. Readers of both go by the offsets within the file and ignore what follows the image. Throws
//! Error where the file cannot be read or written.
void append_checksum(const std::filesystem::path& file);

//! Returns whether a file ends with the checksum of its bytes.
bool has_right_checksum(const std::filesystem::path& file);

}  // namespace ergodome
