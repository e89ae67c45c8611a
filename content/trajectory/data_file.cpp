#include "content/trajectory/data_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

namespace ergodome {

DataFile DataFile::open(const std::filesystem::path& path) {
  DataFile file(path, ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.handle_ < 0 || ::fstat(file.handle_, &status) != 0) {
    file.fail("cannot be opened", "check the path and its permissions");
  }
  if (!S_ISREG(status.st_mode)) {
    throw Error(path.string(), "is not a regular file", "choose a trajectory made by ergodome bake");
  }
  return file;
}

DataFile DataFile::open_locked(const std::filesystem::path& path) {
  std::optional<DataFile> file = try_open_locked(path);
  if (!file) {
    throw Error(path.string(), "is in use by another ergodome bake", "wait until it ends, or bake to another file");
  }
  return std::move(*file);
}

std::optional<DataFile> DataFile::try_open_locked(const std::filesystem::path& path) {
  DataFile file(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (file.handle_ < 0) {
    file.fail("cannot be written", "check the folder and its permissions");
  }
  if (::flock(file.handle_, LOCK_EX | LOCK_NB) != 0) {
    return std::nullopt;
  }
  return file;
}

DataFile::DataFile(DataFile&& other) noexcept
    : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, -1)) {}

DataFile::~DataFile() {
  if (handle_ >= 0) {
    ::close(handle_);
  }
}

std::uint64_t DataFile::size() const {
  struct stat status {};
  if (::fstat(handle_, &status) != 0) {
    fail("cannot be read", "check the disk");
  }
  return static_cast<std::uint64_t>(status.st_size);
}

Bytes DataFile::read(std::uint64_t offset, std::uint64_t count, const std::string& location) const {
  // Checked before memory is allocated: a damaged file can claim any size.
  if (const std::uint64_t all = size(); offset > all || count > all - offset) {
    throw Error(location, "is truncated", "bake it again");
  }
  Bytes bytes(count);
  std::uint64_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(handle_, bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno != EINTR) {
      fail("cannot be read", "check the disk");
    }
    if (got == 0) {
      throw Error(location, "is truncated", "bake it again");
    }
    done += got > 0 ? static_cast<std::uint64_t>(got) : 0;
  }
  return bytes;
}

void DataFile::append(std::span<const std::byte> bytes) {
  if (!write_all(handle_, reinterpret_cast<const char*>(bytes.data()), bytes.size())) {
    fail("cannot be written", "free some space and run the bake again: it continues from what is saved");
  }
  if (::fdatasync(handle_) != 0 && errno != EINVAL) {
    fail("cannot be written", "check the disk");
  }
}

void DataFile::cut(std::uint64_t size) {
  if (::ftruncate(handle_, static_cast<off_t>(size)) != 0) {
    fail("cannot be shortened to its complete part", "check the disk");
  }
}

void DataFile::fail(const char* what, const char* remedy) const {
  throw Error(path_.string(), std::string(what) + ": " + std::strerror(errno), remedy);
}

}  // namespace ergodome
