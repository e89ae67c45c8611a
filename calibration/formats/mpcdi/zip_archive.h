#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! Reads named members of a zip archive in memory. Nothing is ever written to the disk, so a member's name is only ever compared.
//!
//! Archives of strangers are held to bounds: entries, bytes of one member, how many times larger than packed it is, and bytes unpacked
//! from the archive in all. Members are stored or deflated, and not encrypted; their checksums are verified.
class ZipArchive {
 public:
  //! Opens an archive, from which `most_unpacked` bytes may be read in all; `bytes` must outlive it. Throws Error where it is
  //! none, or has too many entries.
  ZipArchive(std::span<const std::byte> bytes, std::string name, std::size_t most_unpacked = std::size_t{2} << 30U);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  //! Returns whether there is a member of that name, regardless of case. Slashes also match backslashes.
  [[nodiscard]] bool has(const std::string& member) const;

  //! A member's bytes. Throws Error, naming archive and member, where it is missing, torn, or beyond a bound.
  std::string read(const std::string& member, std::size_t most_bytes);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  std::string name_;
  std::size_t archive_bytes_ = 0;
  std::size_t unpacked_left_;
};

//! An archive of the given members (name, bytes), deflated, as bytes. The same members make the same archive, byte for byte. Throws
//! Error, naming `name`, when the library refuses.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& members, const std::string& name);

}  // namespace ergodome
