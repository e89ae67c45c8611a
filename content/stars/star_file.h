#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "content/stars/star_catalogue.h"

namespace ergodome {

//! Reads a star catalog in the project's own compact format. Numbers are little-endian.
//!
//!   8 bytes      "ERGOSTAR"
//!   u32          version: 1
//!   u32          number of stars n
//!   u64          size of the compressed part [bytes]
//!   u64          XXH3-64 of the compressed part
//!   u64          XXH3-64 of the preceding 32 bytes
//!   compressed   zstd, 20 n bytes uncompressed: five columns, each stored as byte 0 of all its
//!                numbers, then byte 1 of all, and so on: u32 number; u32 right ascension and i32
//!                declination [1e-7 deg]; i32 V and i32 B-V [1e-3 mag], the minimum i32 for a
//!                missing B-V. Brightest first.
StarCatalogue read_star_file(const std::filesystem::path& path);

//! Parses a star file from memory; `location` is its name in messages. Throws Error if it is
//! damaged, truncated, of a newer version, or of another format.
StarCatalogue parse_star_file(std::span<const std::byte> bytes, const std::string& location);

//! Writes a catalog atomically. Positions are rounded to 1e-7 deg, magnitudes to 0.001.
void write_star_file(const StarCatalogue& catalogue, const std::filesystem::path& path);

//! Returns true if a file begins with this format's signature.
bool is_star_file(const std::filesystem::path& path);

}  // namespace ergodome
