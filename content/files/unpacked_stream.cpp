#include "content/files/unpacked_stream.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t packed_chunk_bytes = 1U << 16U;
//! Maximum compression ratio. Text tables compress by a factor of 3 to 20; a much larger factor
//! indicates a decompression bomb.
constexpr std::uint64_t max_unpacked_ratio = 200;
//! Up to this uncompressed size, any compression ratio is accepted [bytes].
constexpr std::uint64_t harmless_unpacked_bytes = std::uint64_t{64} << 20U;
//! 15 bits of window, plus 16: zlib reads the gzip header and checks the trailer's CRC.
constexpr int gzip_window_bits = 15 + 16;

bool begins_as_gzip(const std::string& bytes, std::size_t at) { return bytes.compare(at, 2, "\x1F\x8B") == 0; }

}  // namespace

struct UnpackedStream::Inflater {
  Inflater() {
    if (inflateInit2(&state, gzip_window_bits) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~Inflater() { inflateEnd(&state); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  z_stream state{};
};

UnpackedStream::UnpackedStream(std::istream& stream, std::string location)
    : stream_(stream), location_(std::move(location)) {
  if (refill() && begins_as_gzip(packed_, 0)) {
    inflater_ = std::make_unique<Inflater>();
    in_member_ = true;
  }
}

UnpackedStream::~UnpackedStream() = default;

bool UnpackedStream::refill() {
  packed_.resize(packed_chunk_bytes);
  stream_.read(packed_.data(), static_cast<std::streamsize>(packed_.size()));
  if (stream_.bad()) {
    throw Error(location_, "cannot be read", "check the disk");
  }
  packed_.resize(static_cast<std::size_t>(stream_.gcount()));
  packed_bytes_ += packed_.size();
  next_ = 0;
  return !packed_.empty();
}

std::size_t UnpackedStream::read(std::span<char> out) {
  if (inflater_) {
    return unpack(out);
  }
  if (next_ == packed_.size() && !refill()) {
    return 0;
  }
  const std::size_t count = std::min(out.size(), packed_.size() - next_);
  std::copy_n(packed_.data() + next_, count, out.data());
  next_ += count;
  return count;
}

std::size_t UnpackedStream::unpack(std::span<char> out) {
  z_stream& state = inflater_->state;
  const std::size_t room = std::min<std::size_t>(out.size(), std::numeric_limits<uInt>::max());
  state.next_out = reinterpret_cast<Bytef*>(out.data());
  state.avail_out = static_cast<uInt>(room);
  while (state.avail_out > 0) {
    if (next_ == packed_.size() && !refill()) {
      if (in_member_) {
        throw Error(location_, "is truncated: its gzip data ends too early", "copy or download it again");
      }
      break;
    }
    if (!in_member_) {
      // Zero bytes pad the end of some archives; other bytes must be another member.
      if (packed_[next_] == '\0') {
        ++next_;
        continue;
      }
      inflateReset(&state);
      in_member_ = true;
    }
    state.next_in = reinterpret_cast<Bytef*>(packed_.data() + next_);
    state.avail_in = static_cast<uInt>(packed_.size() - next_);
    const int result = inflate(&state, Z_NO_FLUSH);
    next_ = packed_.size() - state.avail_in;
    if (result == Z_STREAM_END) {
      in_member_ = false;
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      throw Error(location_, "is damaged: its gzip data cannot be unpacked", "copy or download it again");
    }
  }
  const std::size_t written = room - state.avail_out;
  unpacked_bytes_ += written;
  require_plausible_size();
  return written;
}

void UnpackedStream::require_plausible_size() const {
  if (unpacked_bytes_ > harmless_unpacked_bytes && unpacked_bytes_ / max_unpacked_ratio > packed_bytes_) {
    throw Error(location_, "unpacks to more than 200 times its size, which no real table does",
                "check where the file comes from");
  }
}

}  // namespace ergodome
