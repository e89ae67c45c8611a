#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/playback/sound/mp3_file.h"

namespace ergodome {

//! Returns why a sound file cannot be played to its end; empty if it can. The existing part of a truncated file is played.
std::string sound_problem(const std::filesystem::path& path);

//! A sound file with random access: MP3, and formats of libsndfile such as WAV, FLAC, Ogg Vorbis and Opus.
class AudioFile {
 public:
  static constexpr int most_channels = 8;

  //! Throws Error if it is not a sound file, has no length, more than 8 channels or a rate outside 8 to 192 kHz, or
  //! does not support seeking.
  explicit AudioFile(const std::filesystem::path& path);
  ~AudioFile();
  AudioFile(const AudioFile&) = delete;
  AudioFile& operator=(const AudioFile&) = delete;

  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] int rate_hz() const { return rate_hz_; }
  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] double length_s() const { return static_cast<double>(frames_) / rate_hz_; }

  //! Samples from a frame on, channels side by side, finite and within [-4, 4]. Frames that lie before the file or beyond its end
  //! are silent, or with `loop` those of a file that is repeated without end. False where the file does not hold what it said it
  //! does: the rest is silent then.
  bool read(std::int64_t first_frame, bool loop, std::span<float> samples);

  //! Returns whether its last frame can be read.
  bool has_end();

 private:
  //! Frames that lie within the file; how many of them came.
  std::int64_t read_within(std::int64_t first_frame, std::int64_t count, float* samples);

  struct Close {
    void operator()(void* file) const;
  };
  //! Counts the frames of a file that does not contain its length, by decoding it.
  [[nodiscard]] std::int64_t counted_frames(const std::string& place) const;

  std::unique_ptr<void, Close> file_;  //!< libsndfile's; null of an MP3
  std::unique_ptr<Mp3File> mp3_;
  int channels_ = 0;
  int rate_hz_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t next_frame_ = -1;  //!< where the library would go on; -1: unknown
};

}  // namespace ergodome
