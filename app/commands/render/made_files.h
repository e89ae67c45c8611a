#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ergodome {

//! The files and folders that a run has made, which it may remove again: nothing else, and no file that was changed or replaced since.
class MadeFiles {
 public:
  //! Makes a folder, with those above it, and remembers which of them are new. Throws Error where that cannot be.
  void make_folder(const std::filesystem::path& folder);
  //! Remembers a file that the run has just written.
  void add(const std::filesystem::path& file);

  //! Removes the files that are as the run wrote them. Returns how many those were.
  int remove_files();
  //! Removes the new folders that are empty.
  void remove_folders();

 private:
  struct Written {
    std::filesystem::path file;
    std::filesystem::file_time_type time;
    std::uintmax_t bytes;
  };
  std::vector<Written> files_;
  std::vector<std::filesystem::path> folders_;
};

}  // namespace ergodome
