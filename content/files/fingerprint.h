#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ergodome {

//! Sixteen hexadecimal digits that tell texts apart (XXH3, 64 bits): not against somebody who means it.
std::string fingerprint(std::string_view text);

//! The same of a file's bytes, a mebibyte at a time: some 20 ms for 100 MB that the system has in memory. Of files beyond `most_hashed_bytes` the size and the
//! time of their last change stand in for the bytes. Empty where the file is not there or cannot be read.
std::string fingerprint_of_file(const std::filesystem::path& file);

//! The same of the first bytes of a file, however many. Empty where it has fewer, or cannot be read.
std::string fingerprint_of_start(const std::filesystem::path& file, std::uintmax_t bytes);

//! So that what takes more than some seconds from a disk is not read for its fingerprint alone.
inline constexpr std::uintmax_t most_hashed_bytes = std::uintmax_t{1} << 30U;

}  // namespace ergodome
