#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace ergodome {

//! MPEG audio of layers I to III. Its length is counted frame by frame when it is opened: many
//! files do not contain it, and libsndfile estimates it from the first frame's bit rate.
class Mp3File {
 public:
  //! Opens a file. Returns nullptr if it is not MPEG audio.
  static std::unique_ptr<Mp3File> open(const std::filesystem::path& path);

  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] int rate_hz() const { return rate_hz_; }
  [[nodiscard]] std::int64_t frames() const { return frames_; }

  //! Reads interleaved samples from a frame on. Returns the number of frames read.
  std::int64_t read(std::int64_t first_frame, std::int64_t count, float* samples);

 private:
  struct Close {
    void operator()(void* handle) const;
  };

  Mp3File() = default;
  bool open_handle(const std::filesystem::path& path);

  std::unique_ptr<void, Close> handle_;
  int channels_ = 0;
  int rate_hz_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t next_frame_ = 0;  //!< next frame of the library; -1: unknown
};

}  // namespace ergodome
