#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/playback/clock/show_clock.h"
#include "app/playback/sound/audio_file.h"

namespace ergodome {

//! The mean of the last ten values of a noisy measurement.
class RecentMean {
 public:
  void add(double value) { values_[count_++ % values_.size()] = value; }
  void clear() { count_ = 0; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double mean() const {
    const std::size_t held = std::min(count_, values_.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < held; ++i) {
      sum += values_[i];
    }
    return held == 0 ? 0.0 : sum / static_cast<double>(held);
  }

 private:
  std::array<double, 10> values_{};
  std::size_t count_ = 0;
};

//! Plays one file: keeps some tenths of a second queued, and keeps the sound at the requested
//! position.
//!
//! All calls are on one thread, with the output current.
class AudioVoice {
 public:
  //! Requested sound at a time of the time source.
  struct Wish {
    double position_s = 0.0;  //!< position in the file; negative: silence for that long, then its start
    double speed = 1.0;       //!< 0.5 to 2
    double gain = 1.0;
    MonotonicTime at{};   //!< time at which the requested position is valid
    bool jumped = false;  //!< the show's time jumped, so the position is not continuous
  };

  AudioVoice(std::unique_ptr<AudioFile> file, bool loop, TimeSource source);
  ~AudioVoice();
  AudioVoice(const AudioVoice&) = delete;
  AudioVoice& operator=(const AudioVoice&) = delete;

  //! Continues or starts playing. `latency_s` is the output's. Returns false if the file is
  //! damaged.
  bool play(const Wish& wish, double latency_s);
  void stop();

  [[nodiscard]] const AudioFile& file() const { return *file_; }
  //! Returns how much later than requested the sound is [s]; 0 if not measured.
  [[nodiscard]] double lateness_s() const { return -ahead_s_.mean(); }
  //! Returns how often playing restarted because it was out of sync.
  [[nodiscard]] long restarts() const { return restarts_; }

 private:
  void start(const Wish& wish, double latency_s);
  void refill();
  void queue(unsigned int buffer);
  //! Returns how far the sound is ahead of the request [s].
  [[nodiscard]] double measure(const Wish& wish) const;
  //! Returns the relative change of speed, at most 1 %, that corrects a small offset. Corrects a
  //! larger one by a restart, and then returns 0.
  double keep_in_step(const Wish& wish, double latency_s);
  [[nodiscard]] double wished_now_s(const Wish& wish) const;

  static constexpr std::size_t buffer_count = 6;
  std::unique_ptr<AudioFile> file_;
  bool loop_;
  TimeSource source_;
  unsigned int voice_ = 0;
  std::array<unsigned int, buffer_count> buffers_{};
  std::vector<float> samples_;  //!< samples of one buffer
  int format_ = 0;
  int buffer_frames_ = 0;
  bool playing_ = false;
  bool damaged_ = false;
  std::int64_t queue_start_ = 0;  //!< frame of the file at the start of the queue
  std::int64_t queue_end_ = 0;
  RecentMean ahead_s_;
  bool settled_ = false;  //!< was measured to be in sync after its start
  double lead_s_ = 0.0;   //!< time by which starts were late, in addition to the reported latency
  MonotonicTime started_{};
  long restarts_ = 0;
};

}  // namespace ergodome
