#include "content/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

void flush_to_disk(const std::filesystem::path& file, const std::filesystem::path& final_name) {
  const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = handle >= 0 && ::fsync(handle) == 0;
  const int problem = errno;
  if (handle >= 0) {
    ::close(handle);
  }
  if (!flushed) {
    throw Error(final_name.string(), std::string("cannot be written: ") + std::strerror(problem),
                "free some space or choose another folder");
  }
}

//! Where a file is to be put: behind links, which stay. Devices, pipes and folders would be lost by it, or cannot be written so.
std::filesystem::path target_of(const std::filesystem::path& path) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (!std::filesystem::exists(status)) {
    return path;
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw Error(path.string(), "is there, and is no file", "give the name of a file");
  }
  const std::filesystem::path behind = std::filesystem::canonical(path, problem);
  return problem ? path : behind;
}

}  // namespace

void write_atomically(const std::filesystem::path& named,
                      const std::function<void(const std::filesystem::path& partial)>& write) {
  const std::filesystem::path path = target_of(named);
  // The ending stays, because image writers choose their format by it.
  std::filesystem::path partial = path;
  partial.replace_filename(".partial-" + std::to_string(::getpid()) + "-" + path.filename().string());
  std::error_code ignored;
  try {
    write(partial);
    flush_to_disk(partial, path);
    std::error_code problem;
    std::filesystem::rename(partial, path, problem);
    if (problem) {
      throw Error(path.string(), "cannot be written: " + problem.message(), "check the folder and its permissions");
    }
  } catch (...) {
    std::filesystem::remove(partial, ignored);
    throw;
  }
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    std::ofstream file(partial, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
      throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno),
                  "check the folder, its permissions and the space left");
    }
  });
}

void keep_older(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) {
    return;
  }
  std::filesystem::path kept = path;
  kept += ".bak";
  write_atomically(kept, [&](const std::filesystem::path& partial) {
    std::error_code failed;
    std::filesystem::copy_file(path, partial, std::filesystem::copy_options::overwrite_existing, failed);
    if (failed) {
      throw Error(kept.string(), "cannot be written: " + failed.message(), "check the folder and its permissions");
    }
  });
}

void write_text_keeping_older(const std::filesystem::path& path, std::string_view text) {
  std::error_code problem;
  const auto bytes = std::filesystem::file_size(path, problem);
  if (!problem && bytes == text.size() &&
      read_whole_file(path, text.size(), "check the file and its permissions") == text) {
    return;
  }
  keep_older(path);
  write_text_atomically(path, text);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) {
    throw Error(folder.string(), "cannot be made: " + problem.message(), "choose another folder");
  }
}

}  // namespace ergodome
