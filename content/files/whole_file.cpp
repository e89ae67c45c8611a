#include "content/files/whole_file.h"

#include <fmt/format.h>

#include <atomic>
#include <fstream>

#include "kernels/core/error.h"

namespace ergodome {

std::string read_whole_file(const std::filesystem::path& path, std::size_t max_bytes, const std::string& remedy) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "does not exist or is not a regular file", remedy);
  }
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  if (problem || size > max_bytes) {
    throw Error(path.string(), fmt::format("is larger than {} MiB", max_bytes >> 20U), remedy);
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) {
    throw Error(path.string(), "cannot be read", "check its permissions");
  }
  return bytes;
}

namespace {

std::atomic<bool> stopped = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may store it");

}  // namespace

void stop_reading() noexcept { stopped.store(true, std::memory_order_relaxed); }

void throw_if_reading_stopped(const std::string& location) {
  if (stopped.load(std::memory_order_relaxed)) {
    throw Error(location, "was not read completely, because the program was asked to stop", "run it again");
  }
}

}  // namespace ergodome
