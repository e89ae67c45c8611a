#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

//! MPEG audio of layers I to III. Its length is counted frame by frame when it is opened: many
//! files do not contain their length, and libsndfile estimates it from the first frame's bit rate.
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
  std::int64_t next_frame_ = 0;  //!< next frame that the library will read; -1: unknown
};

//! Returns why a sound file cannot be played to its end; empty if it can. A truncated file is
//! played as far as it exists.
std::string sound_problem(const std::filesystem::path& path);

//! A sound file with random access: MP3, and formats of libsndfile such as WAV, FLAC, Ogg Vorbis
//! and Opus.
class AudioFile {
 public:
  static constexpr int max_channels = 8;

  //! Throws Error if it is not a sound file of a supported format, is a chain of Ogg streams, has
  //! no length, more than 8 channels or a rate outside 8 to 192 kHz, or does not support seeking.
  explicit AudioFile(const std::filesystem::path& path);
  ~AudioFile();
  AudioFile(const AudioFile&) = delete;
  AudioFile& operator=(const AudioFile&) = delete;

  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] int rate_hz() const { return rate_hz_; }
  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] double length_s() const { return static_cast<double>(frames_) / rate_hz_; }

  //! Reads interleaved samples from a frame on; they are finite and within [-4, 4]. Frames outside
  //! the file are silent; with `loop`, the file repeats endlessly. Returns false if the file is
  //! shorter than its header states; the rest is then silent.
  bool read(std::int64_t first_frame, bool loop, std::span<float> samples);

  //! Returns whether its last frame can be read.
  bool has_end();

 private:
  //! Reads frames within the file. Returns how many were read.
  std::int64_t read_within(std::int64_t first_frame, std::int64_t count, float* samples);

  struct Close {
    void operator()(void* file) const;
  };
  //! Counts the frames of a file that does not contain its length, by decoding it.
  [[nodiscard]] std::int64_t counted_frames(const std::string& location) const;

  std::unique_ptr<void, Close> file_;  //!< libsndfile's handle; null for MP3
  std::unique_ptr<Mp3File> mp3_;
  int channels_ = 0;
  int rate_hz_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t next_frame_ = -1;  //!< next frame that libsndfile will read; -1: unknown
};

}  // namespace ergodome
