#include "render/output/file_checksum.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "content/files/fingerprint.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::string_view mark = "\nergodome-xxh3=";
constexpr std::size_t digits = 16;
constexpr std::size_t mark_bytes = mark.size() + digits + 1;  // plus a line break

std::string mark_of(const std::string& checksum) { return std::string(mark) + checksum + "\n"; }

}  // namespace

void append_checksum(const std::filesystem::path& file) {
  std::error_code problem;
  const std::uintmax_t bytes = std::filesystem::file_size(file, problem);
  const std::string checksum = problem ? "" : fingerprint_of_start(file, bytes);
  std::ofstream to(file, std::ios::binary | std::ios::app);
  to << mark_of(checksum);
  to.close();
  if (checksum.empty() || !to) {
    throw Error(file.string(), std::string("cannot be written: ") + std::strerror(errno),
                "check the folder, its permissions and the free space");
  }
}

bool has_right_checksum(const std::filesystem::path& file) {
  std::error_code problem;
  const std::uintmax_t bytes = std::filesystem::file_size(file, problem);
  if (problem || bytes < mark_bytes) {
    return false;
  }
  std::string end(mark_bytes, '\0');
  std::ifstream from(file, std::ios::binary);
  from.seekg(static_cast<std::streamoff>(bytes - mark_bytes));
  from.read(end.data(), static_cast<std::streamsize>(end.size()));
  return from && end.starts_with(mark) && end == mark_of(fingerprint_of_start(file, bytes - mark_bytes));
}

}  // namespace ergodome
