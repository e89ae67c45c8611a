#include "app/commands/render/created_files.h"

#include <algorithm>

#include "content/files/atomic_file.h"

namespace ergodome {

namespace fs = std::filesystem;

void CreatedFiles::make_folder(const fs::path& folder) {
  std::vector<fs::path> missing;
  for (fs::path each = folder; !each.empty() && !fs::exists(each); each = each.parent_path()) {
    missing.push_back(each);
  }
  ergodome::make_folder(folder);
  folders_.insert(folders_.end(), missing.rbegin(), missing.rend());
}

void CreatedFiles::add(const fs::path& file) {
  std::error_code problem;
  const fs::file_time_type time = fs::last_write_time(file, problem);
  const std::uintmax_t bytes = problem ? 0 : fs::file_size(file, problem);
  if (!problem) {
    files_.push_back({file, time, bytes});
  }
}

int CreatedFiles::remove_files() {
  int removed = 0;
  for (const Written& each : files_) {
    std::error_code problem;
    const bool as_written = fs::is_regular_file(fs::symlink_status(each.file, problem)) &&
                            fs::last_write_time(each.file, problem) == each.time &&
                            fs::file_size(each.file, problem) == each.bytes && !problem;
    removed += as_written && fs::remove(each.file, problem) ? 1 : 0;
  }
  files_.clear();
  return removed;
}

void CreatedFiles::remove_folders() {
  // Removes inner folders first, which were created last.
  std::for_each(folders_.rbegin(), folders_.rend(), [](const fs::path& folder) {
    std::error_code not_empty;
    fs::remove(folder, not_empty);
  });
  folders_.clear();
}

}  // namespace ergodome
