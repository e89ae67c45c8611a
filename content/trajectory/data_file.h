#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "content/files/bytes.h"

namespace ergodome {

//! An open binary file that several threads can read concurrently. System errors are thrown as
//! Error with the file's name.
class DataFile {
 public:
  //! Opens a file for reading.
  static DataFile open(const std::filesystem::path& path);

  //! Opens a file for reading and appending, and locks it against other processes. Creates it if it
  //! does not exist. Throws Error if another process has locked it.
  static DataFile open_locked(const std::filesystem::path& path);

  //! Does the same as open_locked(), but returns nothing if another process has locked the file.
  static std::optional<DataFile> try_open_locked(const std::filesystem::path& path);

  DataFile(DataFile&& other) noexcept;
  DataFile& operator=(DataFile&&) = delete;
  ~DataFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  //! Reads `count` bytes at an offset. Throws Error, which names `location`, if the file is too
  //! short.
  [[nodiscard]] Bytes read(std::uint64_t offset, std::uint64_t count, const std::string& location) const;

  //! Appends bytes and flushes them to the disk. An interruption may leave a part of them, which
  //! cut() can remove.
  void append(std::span<const std::byte> bytes);

  //! Truncates the file to `size` bytes.
  void cut(std::uint64_t size);

 private:
  DataFile(std::filesystem::path path, int handle) : path_(std::move(path)), handle_(handle) {}
  [[noreturn]] void fail(const char* what, const char* remedy) const;

  std::filesystem::path path_;
  int handle_;
};

}  // namespace ergodome
