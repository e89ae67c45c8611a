#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ergodome {

//! The files and folders that a run has created and may remove again. Never removes other files, or
//! files that were changed since.
class CreatedFiles {
 public:
  //! Creates a folder and its parents, and records which of them are new. Throws Error if that
  //! fails.
  void make_folder(const std::filesystem::path& folder);
  //! Records a file that the run has just written.
  void add(const std::filesystem::path& file);

  //! Removes the files that have not changed since the run wrote them. Returns their number.
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
