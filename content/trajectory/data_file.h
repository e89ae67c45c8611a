#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "content/trajectory/bytes.h"

namespace ergodome {

//! An open file of bytes that several threads may read at once. Errors of the system leave as Error with the file's name.
class DataFile {
 public:
  //! Opens for reading.
  static DataFile open(const std::filesystem::path& path);

  //! Opens for reading and appending, made where it is not there, and locked against other processes. Throws Error where one has it.
  static DataFile open_locked(const std::filesystem::path& path);

  DataFile(DataFile&& other) noexcept;
  DataFile& operator=(DataFile&&) = delete;
  ~DataFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  //! `count` bytes from an offset. Throws Error, as `place`, where the file ends before.
  [[nodiscard]] Bytes read(std::uint64_t offset, std::uint64_t count, const std::string& place) const;

  //! Writes at the end, down to the disk: what is cut off by a kill or a full disk, the next `cut` takes away.
  void append(std::span<const std::byte> bytes);

  //! Takes away what follows the first `size` bytes.
  void cut(std::uint64_t size);

 private:
  DataFile(std::filesystem::path path, int handle) : path_(std::move(path)), handle_(handle) {}
  [[noreturn]] void fail(const char* what, const char* remedy) const;

  std::filesystem::path path_;
  int handle_;
};

}  // namespace ergodome
