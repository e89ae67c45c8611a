#pragma once

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace ergodome {

//! The program's log: lines with time and level, to `sinks` and to a file that is turned over before it outgrows a mebibyte, the last five of
//! which are kept. An empty path, or one that cannot be opened, leaves the file out; the log says so. Lines that cannot be
//! written later, on a full disk, are told once on the standard error.
std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file, std::vector<spdlog::sink_ptr> sinks);

}  // namespace ergodome
