#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "content/stars/star_catalogue.h"

namespace ergodome {

//! The project's own form of a star catalogue: small, and quick to read. Numbers are little-endian.
//!
//!   8 bytes   "ERGOSTAR"
//!   u32       version: 1
//!   u32       number of stars n
//!   u64       bytes of the packed part
//!   u64       XXH3-64 of the packed part
//!   u64       XXH3-64 of the 32 bytes before
//!   packed    zstd, 20 n bytes unpacked: byte 0 of all first numbers, byte 1 of all first numbers, and so on, of five columns:
//!             u32 number; u32 right ascension and i32 declination [1e-7 deg]; i32 V and i32 B-V [1e-3 mag], the least i32 where B-V is
//!             missing. Brightest first.
StarCatalogue read_star_file(const std::filesystem::path& path);

//! The same from memory; `place` goes into errors. Throws Error for what is damaged, cut off, of a newer version, or no such file.
StarCatalogue parse_star_file(std::span<const std::byte> bytes, const std::string& place);

//! Writes a catalogue, whole or not at all. Places are rounded to 1e-7 deg, magnitudes to 0.001.
void write_star_file(const StarCatalogue& catalogue, const std::filesystem::path& path);

//! Whether a file begins like one.
bool is_star_file(const std::filesystem::path& path);

}  // namespace ergodome
