#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! Reads named members of a zip archive in memory. Writes nothing to the disk. Member names are
//! only compared with requested names, never used as paths.
//!
//! Archives are untrusted: there are limits for entries, bytes of a member, its compression ratio,
//! and the bytes decompressed in total. Members must be stored or deflated, and not encrypted.
//! Their checksums are verified.
class ZipArchive {
 public:
  //! Opens an archive, from which at most `max_unpacked` bytes may be read in total; `bytes` must
  //! outlive it. Throws Error if it is not an archive, or has too many entries.
  ZipArchive(std::span<const std::byte> bytes, std::string name, std::size_t max_unpacked = std::size_t{2} << 30U);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  //! Returns true if there is a member with this name in any case. Slashes also match backslashes.
  [[nodiscard]] bool has(const std::string& member) const;

  //! Returns a member's bytes. Throws Error, which names archive and member, if it is missing,
  //! damaged, or beyond a limit.
  std::string read(const std::string& member, std::size_t max_bytes);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  std::string name_;
  std::size_t archive_bytes_ = 0;
  std::size_t unpacked_left_;
};

//! Returns an archive of the given members (name, bytes), deflated. The same members always produce
//! the same bytes. Throws Error, which names `name`, if libzip fails.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& members, const std::string& name);

}  // namespace ergodome
