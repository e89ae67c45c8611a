#include "content/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

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
                "free some space, or choose another folder");
  }
}

constexpr std::string_view partial_prefix = ".partial-";
constexpr std::size_t random_digits = 16;

std::string partial_name(const std::filesystem::path& path) {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) {
    throw Error(path.string(),
                std::string("cannot be written: no random numbers for a temporary name: ") + std::strerror(errno),
                "try again");
  }
  return fmt::format("{}{:016x}-{}", partial_prefix, number, path.filename().string());
}

//! Returns true if a name is that of a partial file.
bool is_partial(std::string_view name) {
  const std::string_view digits = name.substr(std::min(partial_prefix.size(), name.size()), random_digits);
  return name.starts_with(partial_prefix) && digits.size() == random_digits &&
         digits.find_first_not_of("0123456789abcdef") == std::string_view::npos &&
         name.substr(partial_prefix.size() + random_digits).starts_with('-');
}

//! A partial file that is locked while this process writes it. The lock ends with the process, on
//! any machine and in any container.
class PartialFile {
 public:
  explicit PartialFile(const std::filesystem::path& path) : path_(path) {
    // Partial names end with the extension of the final name, because image writers choose their
    // format from it.
    do {
      close();
      path_.replace_filename(partial_name(path));
      handle_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (handle_ < 0) {
        throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno),
                    "check the folder, its permissions and the free space");
      }
    } while (!lock());
  }
  ~PartialFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    close();
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  //! Locks the file. Returns false if another process removed it as abandoned before it was locked.
  //! On a file system without locks no file is removed as abandoned.
  [[nodiscard]] bool lock() const {
    if (::flock(handle_, LOCK_EX | LOCK_NB) != 0) {
      return errno != EWOULDBLOCK;
    }
    struct stat opened = {};
    return ::fstat(handle_, &opened) != 0 || opened.st_nlink > 0;
  }
  void close() {
    if (handle_ >= 0) {
      ::close(std::exchange(handle_, -1));
    }
  }

  std::filesystem::path path_;
  int handle_ = -1;
};

}  // namespace

std::filesystem::path behind_links(const std::filesystem::path& path) {
  constexpr int max_links = 40;  // the limit of the operating system
  std::error_code problem;
  std::filesystem::path at = path;
  // The target of the last link may not exist, so functions that resolve all links at once would
  // fail.
  for (int i = 0; i < max_links && std::filesystem::is_symlink(at, problem); ++i) {
    const std::filesystem::path target = std::filesystem::read_symlink(at, problem);
    at = target.is_absolute() ? target : at.parent_path() / target;
  }
  if (std::filesystem::is_symlink(at, problem)) {
    throw Error(path.string(), "is a symbolic link that points to itself", "remove the link, or point it to a file");
  }
  return at;
}

void require_writable(const std::filesystem::path& named) {
  std::filesystem::path kept = named;
  kept += ".bak";
  std::error_code unknown;
  for (const std::filesystem::path& each : {named, kept}) {
    const std::filesystem::file_status status = std::filesystem::status(behind_links(each), unknown);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      throw Error(each.string(), "cannot be written: a directory or device with that name exists",
                  "move it, or choose another folder");
    }
  }
  std::filesystem::path folder = std::filesystem::absolute(behind_links(named)).parent_path();
  while (!std::filesystem::exists(folder, unknown) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  if (!std::filesystem::is_directory(folder, unknown)) {
    throw Error(named.string(), "cannot be written: " + folder.string() + " is not a folder", "choose another folder");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(named.string(),
                "cannot be written: no permission to create files in " + folder.string() + ": " + std::strerror(errno),
                "check its permissions, or choose another folder");
  }
}

void write_atomically(const std::filesystem::path& named,
                      const std::function<void(const std::filesystem::path& partial)>& write) {
  const std::filesystem::path path = behind_links(named);
  std::error_code unknown;
  const std::filesystem::file_status status = std::filesystem::status(path, unknown);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(named.string(), "cannot be written: a directory or device with that name exists",
                "choose another name");
  }
  const PartialFile partial(path);
  write(partial.path());
  flush_to_disk(partial.path(), path);
  std::error_code problem;
  std::filesystem::rename(partial.path(), path, problem);
  if (problem) {
    throw Error(path.string(), "cannot be written: " + problem.message(), "check the folder and its permissions");
  }
}

void remove_abandoned_files(const std::filesystem::path& folder) {
  std::error_code problem;
  for (const auto& each : std::filesystem::directory_iterator(folder.empty() ? "." : folder, problem)) {
    if (!is_partial(each.path().filename().string())) {
      continue;
    }
    const int handle = ::open(each.path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (handle >= 0 && ::flock(handle, LOCK_EX | LOCK_NB) == 0) {
      std::error_code stays;
      std::filesystem::remove(each.path(), stays);
    }
    if (handle >= 0) {
      ::close(handle);
    }
  }
}

bool disk_is_full(const std::filesystem::path& file) {
  constexpr std::uintmax_t next_to_nothing_bytes = 64U << 10U;
  std::error_code problem;
  const std::filesystem::space_info space =
      std::filesystem::space(std::filesystem::absolute(file).parent_path(), problem);
  return !problem && space.available < next_to_nothing_bytes;
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    std::ofstream file(partial, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
      throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno),
                  "check the folder, its permissions and the free space");
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
    throw Error(folder.string(), "cannot be created: " + problem.message(), "choose another folder");
  }
}

bool write_all(int handle, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(handle, bytes, count);
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return false;
    }
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace ergodome
