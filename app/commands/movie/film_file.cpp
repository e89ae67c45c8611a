#include "app/commands/movie/film_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Bytes that make_gap() moves at a time.
constexpr std::uint64_t moved_bytes = 8U << 20U;

}  // namespace

FilmFile::FilmFile(const std::filesystem::path& file, std::string film)
    : film_(std::move(film)), handle_(::open(file.c_str(), O_RDWR | O_CLOEXEC)) {
  struct stat facts {};
  if (handle_ < 0 || ::fstat(handle_, &facts) != 0) {
    const int problem = errno;
    if (handle_ >= 0) {
      ::close(handle_);
    }
    throw Error(film_, std::string("cannot be opened to add VR metadata: ") + std::strerror(problem),
                "the frames are complete; continue with --resume");
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

FilmFile::~FilmFile() { ::close(handle_); }

std::string FilmFile::read(std::uint64_t offset, std::uint64_t count) const {
  if (offset > size_ || count > size_ - offset) {
    refuse(offset, "it ends too early");
  }
  std::string bytes(count, '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(handle_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      throw Error(
          film_,
          std::string("cannot be read to add VR metadata: ") + (got < 0 ? std::strerror(errno) : "it ends too early"),
          "the frames are complete; continue with --resume");
    }
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

void FilmFile::write(std::uint64_t offset, std::string_view bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t put = ::pwrite(handle_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) {
      continue;
    }
    if (put < 0) {
      throw Error(film_, std::string("cannot be written: ") + std::strerror(errno),
                  "the frames are complete; free some space or choose another folder, and continue with --resume");
    }
    done += static_cast<std::size_t>(put);
  }
  size_ = std::max(size_, offset + bytes.size());
}

void FilmFile::make_gap(std::uint64_t offset, std::uint64_t count) {
  for (std::uint64_t end = size_; end > offset;) {
    const std::uint64_t begin = end - std::min(end - offset, moved_bytes);
    write(begin + count, read(begin, end - begin));
    end = begin;
  }
}

void FilmFile::refuse(std::uint64_t offset, const std::string& problem) const {
  throw Error(film_, fmt::format("cannot get VR metadata: at byte {}, {}", offset, problem),
              "the frames are complete; try another format (.mp4, .mov, .mkv) with --resume, or another version of "
              "ffmpeg");
}

void append_big_endian(std::string& text, std::uint64_t value, int bytes) {
  for (int i = bytes - 1; i >= 0; --i) {
    text += static_cast<char>(value >> (8U * static_cast<unsigned>(i)) & 255U);
  }
}

std::uint64_t big_endian_number(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) {
    value = value << 8U | static_cast<unsigned char>(byte);
  }
  return value;
}

}  // namespace ergodome
