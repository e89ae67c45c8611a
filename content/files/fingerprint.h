#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ergodome {

//! Returns sixteen hexadecimal digits that distinguish texts (XXH3, 64 bits), but are not secure
//! against deliberate collisions.
std::string fingerprint(std::string_view text);

//! Returns the fingerprint of a file's bytes, read one mebibyte at a time (about 20 ms for 100 MB
//! in the file cache). For files above `max_hashed_bytes`, size and modification time replace the
//! bytes. Returns an empty text if the file is missing or unreadable.
std::string fingerprint_of_file(const std::filesystem::path& file);

//! Returns the fingerprint of the first `bytes` bytes of a file, also above `max_hashed_bytes`.
//! Returns an empty text if the file is shorter or unreadable.
std::string fingerprint_of_start(const std::filesystem::path& file, std::uintmax_t bytes);

//! Maximum size of files that are hashed completely [bytes]. Larger ones would take more than a few
//! seconds to read from a disk.
inline constexpr std::uintmax_t max_hashed_bytes = std::uintmax_t{1} << 30U;

}  // namespace ergodome
