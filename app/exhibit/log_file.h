#pragma once

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace ergodome {

//! Opens the program's log: lines with time and level, to `sinks` and to a file that is rotated at
//! 1 MiB; five files are kept. An empty path means no file. If the file cannot be opened, the log
//! warns and continues without it. Only the first later write error, such as on a full disk, is
//! reported, on stderr.
std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file, std::vector<spdlog::sink_ptr> sinks);

}  // namespace ergodome
