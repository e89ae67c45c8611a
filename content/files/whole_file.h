#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace ergodome {

//! Returns a file's bytes. Throws Error if it is missing, not a regular file, unreadable, or larger
//! than `max_bytes`, so that no memory is allocated for files too large for their format. `remedy`
//! states what kind of file is expected.
std::string read_whole_file(const std::filesystem::path& path, std::size_t max_bytes, const std::string& remedy);

//! Makes all file readers stop, on all threads, because the program is about to end. Safe in a
//! signal handler.
void stop_reading() noexcept;

//! Throws Error after stop_reading() was called. Readers call it in long loops; it costs one atomic
//! load.
void throw_if_reading_stopped(const std::string& location);

}  // namespace ergodome
