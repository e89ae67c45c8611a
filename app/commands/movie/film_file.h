#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ergodome {

//! The file of a film before it gets its final name, open for changes in place.
class FilmFile {
 public:
  //! Opens a file. Messages name `film`, the film that it becomes. Throws Error if it cannot be
  //! opened.
  FilmFile(const std::filesystem::path& file, std::string film);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  [[nodiscard]] std::uint64_t size() const { return size_; }

  //! Returns `count` bytes from an offset. Throws Error if the file ends before.
  [[nodiscard]] std::string read(std::uint64_t offset, std::uint64_t count) const;

  //! Writes bytes at an offset. Throws Error if the disk is full or cannot be written.
  void write(std::uint64_t offset, std::string_view bytes);

  //! Moves everything from an offset on by `count` bytes towards the end. The bytes of the gap are
  //! undefined.
  void make_gap(std::uint64_t offset, std::uint64_t count);

  //! Throws Error: the film has an unexpected structure at an offset.
  [[noreturn]] void refuse(std::uint64_t offset, const std::string& problem) const;

 private:
  std::string film_;
  int handle_ = -1;
  std::uint64_t size_ = 0;
};

//! Appends an unsigned integer of `bytes` bytes, the most significant first.
void append_big_endian(std::string& text, std::uint64_t value, int bytes);

//! Returns the unsigned integer of at most eight bytes, the most significant first.
std::uint64_t big_endian_number(std::string_view bytes);

}  // namespace ergodome
