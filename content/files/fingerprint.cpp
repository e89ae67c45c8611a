#include "content/files/fingerprint.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

namespace ergodome {

namespace {

std::string hexadecimal(XXH64_hash_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace

std::string fingerprint(std::string_view text) { return hexadecimal(XXH3_64bits(text.data(), text.size())); }

std::string fingerprint_of_file(const std::filesystem::path& file) {
  std::error_code size_problem;
  std::error_code time_problem;
  const std::uintmax_t bytes = std::filesystem::file_size(file, size_problem);
  const auto time = std::filesystem::last_write_time(file, time_problem);
  if (size_problem || time_problem) {
    return "";
  }
  if (bytes > max_hashed_bytes) {
    return fmt::format("{} {}", bytes, time.time_since_epoch().count());
  }
  return fingerprint_of_start(file, bytes);
}

std::string fingerprint_of_start(const std::filesystem::path& file, std::uintmax_t bytes) {
  std::ifstream from(file, std::ios::binary);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::vector<char> chunk(std::size_t{1} << 20U);
  while (bytes > 0) {
    const std::size_t count = std::min<std::uintmax_t>(bytes, chunk.size());
    if (!from.read(chunk.data(), static_cast<std::streamsize>(count))) {
      return "";
    }
    XXH3_64bits_update(state.get(), chunk.data(), count);
    bytes -= count;
  }
  return hexadecimal(XXH3_64bits_digest(state.get()));
}

}  // namespace ergodome
