#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace ergodome {

//! MPEG audio of layers I to III. Its length is counted frame by frame when it is opened: many files do not contain it, and libsndfile
//! then guesses it from the first frame's bit rate.
class Mp3File {
 public:
  //! Returns nullptr if the file is no MPEG audio.
  static std::unique_ptr<Mp3File> open(const std::filesystem::path& path);

  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] int rate_hz() const { return rate_hz_; }
  [[nodiscard]] std::int64_t frames() const { return frames_; }

  //! Reads samples from a frame on, channels side by side; returns how many frames came.
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
  std::int64_t next_frame_ = 0;  //!< where the library goes on; -1: unknown
};

}  // namespace ergodome
