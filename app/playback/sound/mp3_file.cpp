#include "app/playback/sound/mp3_file.h"

#include <mpg123.h>

#include <cstddef>
#include <utility>

namespace ergodome {

namespace {

mpg123_handle* handle_of(void* handle) { return static_cast<mpg123_handle*>(handle); }

}  // namespace

void Mp3File::Close::operator()(void* handle) const { mpg123_delete(handle_of(handle)); }

std::unique_ptr<Mp3File> Mp3File::open(const std::filesystem::path& path) {
  static const bool ready = mpg123_init() == MPG123_OK;
  std::unique_ptr<Mp3File> file(new Mp3File);
  return ready && file->open_handle(path) ? std::move(file) : nullptr;
}

bool Mp3File::open_handle(const std::filesystem::path& path) {
  handle_.reset(mpg123_new(nullptr, nullptr));
  mpg123_handle* const handle = handle_of(handle_.get());
  if (handle == nullptr) {
    return false;
  }
  mpg123_param(handle, MPG123_ADD_FLAGS, MPG123_QUIET | MPG123_FORCE_FLOAT, 0.0);
  long rate = 0;
  int encoding = 0;
  if (mpg123_open(handle, path.c_str()) != MPG123_OK ||
      mpg123_getformat(handle, &rate, &channels_, &encoding) != MPG123_OK) {
    return false;
  }
  // The format of the first frame applies to the whole file.
  mpg123_format_none(handle);
  if (mpg123_format(handle, rate, channels_ == 1 ? MPG123_MONO : MPG123_STEREO, MPG123_ENC_FLOAT_32) != MPG123_OK ||
      mpg123_scan(handle) != MPG123_OK) {
    return false;
  }
  rate_hz_ = static_cast<int>(rate);
  frames_ = mpg123_length(handle);
  return frames_ > 0;
}

std::int64_t Mp3File::read(std::int64_t first_frame, std::int64_t count, float* samples) {
  mpg123_handle* const handle = handle_of(handle_.get());
  if (next_frame_ != first_frame && mpg123_seek(handle, first_frame, SEEK_SET) != first_frame) {
    next_frame_ = -1;
    return 0;
  }
  const std::size_t frame_bytes = sizeof(float) * static_cast<std::size_t>(channels_);
  const std::size_t wanted = frame_bytes * static_cast<std::size_t>(count);
  std::size_t came = 0;
  for (int result = MPG123_OK; came < wanted && (result == MPG123_OK || result == MPG123_NEW_FORMAT);) {
    std::size_t part = 0;
    result = mpg123_read(handle, reinterpret_cast<unsigned char*>(samples) + came, wanted - came, &part);
    came += part;
  }
  const auto frames = static_cast<std::int64_t>(came / frame_bytes);
  next_frame_ = frames == count ? first_frame + count : -1;
  return frames;
}

}  // namespace ergodome
