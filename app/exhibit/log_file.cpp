#include "app/exhibit/log_file.h"

#include <fmt/format.h>
#include <spdlog/sinks/rotating_file_sink.h>

#include <atomic>
#include <cstdio>
#include <exception>
#include <string>

#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_bytes = 1U << 20U;
constexpr std::size_t kept_files = 4;  // in addition to the current one

}  // namespace

std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file, std::vector<spdlog::sink_ptr> sinks) {
  std::string problem;
  if (!file.empty()) {
    try {
      make_folder(file.parent_path());
      // Opening a pipe would block until it has a reader.
      if (std::filesystem::is_fifo(std::filesystem::status(file))) {
        throw Error(file.string(), "is a pipe and not a file", "remove it");
      }
      sinks.push_back(std::make_shared<spdlog::sinks::rotating_file_sink_mt>(file.string(), largest_bytes, kept_files));
    } catch (const std::exception& error) {
      problem = error.what();
    }
  }
  auto log = std::make_shared<spdlog::logger>("ergodome", sinks.begin(), sinks.end());
  log->flush_on(spdlog::level::info);
  // A full disk must not stop a show. If one sink fails, the others continue. The failure is
  // printed on stderr, which may be a file on the same disk, so nothing is thrown if that fails
  // too.
  log->set_error_handler([file, reported = std::make_shared<std::atomic_flag>()](const std::string& failure) {
    if (!reported->test_and_set()) {
      const std::string line =
          fmt::format("ergodome: {}: cannot write the log: {}; free disk space or make the folder writable\n",
                      file.string(), failure);
      std::fputs(line.c_str(), stderr);
    }
  });
  if (!problem.empty()) {
    log->warn("no log file: {}", problem);
  }
  return log;
}

}  // namespace ergodome
