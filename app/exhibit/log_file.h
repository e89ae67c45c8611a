#pragma once

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace ergodome {

//! Opens the program's log: lines with time and level, to `sinks` and to a file that is rotated at
//! 1 MiB, of which the last five are kept. If the path is empty or cannot be opened, there is no
//! file, which the log notes. Later write errors, such as on a full disk, are reported once on
//! stderr.
std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file, std::vector<spdlog::sink_ptr> sinks);

}  // namespace ergodome
