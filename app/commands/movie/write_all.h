#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>

namespace ergodome {

//! Writes all bytes to an open file or pipe. Returns false, with errno set, on failure.
inline bool write_all(int handle, const char* bytes, std::size_t count) {
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
