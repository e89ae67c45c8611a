#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/playback/show_time.h"
#include "app/playback/sound/audio_file.h"

namespace ergodome {

//! The mean of the last measurements of something noisy.
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

//! One file on its way to the loudspeakers: keeps some tenths of a second of it queued, and what is heard at the place it is told.
//!
//! All calls are made on one thread, with the output current.
class AudioVoice {
 public:
  //! What is to be heard, at the time that the source of time tells.
  struct Wish {
    double place_s = 0.0;  //!< of the file; below 0: it begins so much later
    double speed = 1.0;    //!< 0.5 to 2
    double gain = 1.0;
    MonotonicTime at{};   //!< when that is so
    bool jumped = false;  //!< the place was set, and not run to
  };

  AudioVoice(std::unique_ptr<AudioFile> file, bool loop, TimeSource source);
  ~AudioVoice();
  AudioVoice(const AudioVoice&) = delete;
  AudioVoice& operator=(const AudioVoice&) = delete;

  //! Goes on, or begins. `latency_s` is the output's. False where the file turns out to be damaged.
  bool play(const Wish& wish, double latency_s);
  void stop();

  [[nodiscard]] const AudioFile& file() const { return *file_; }
  //! How much later than what is wished is what is heard; 0 where nothing has been measured [s].
  [[nodiscard]] double lateness_s() const { return -ahead_s_.mean(); }
  //! How often it had to begin anew because it was out of step.
  [[nodiscard]] long restarts() const { return restarts_; }

 private:
  void start(const Wish& wish, double latency_s);
  void refill();
  void queue(unsigned int buffer);
  //! How far ahead of the wish is what is heard [s].
  [[nodiscard]] double measure(const Wish& wish) const;
  //! Change of speed that brings the sound back in step, or a new beginning.
  double keep_in_step(const Wish& wish, double latency_s);
  [[nodiscard]] double wished_now_s(const Wish& wish) const;

  static constexpr std::size_t buffer_count = 6;
  std::unique_ptr<AudioFile> file_;
  bool loop_;
  TimeSource source_;
  unsigned int voice_ = 0;
  std::array<unsigned int, buffer_count> buffers_{};
  std::vector<float> samples_;  //!< of one buffer
  int format_ = 0;
  int buffer_frames_ = 0;
  bool playing_ = false;
  bool damaged_ = false;
  std::int64_t queue_start_ = 0;  //!< frame of the file with which the queue begins
  std::int64_t queue_end_ = 0;
  RecentMean ahead_s_;
  bool settled_ = false;  //!< measured after its beginning, and found in step
  double lead_s_ = 0.0;   //!< by which beginnings have been found late, beside the latency that is told
  MonotonicTime started_{};
  long restarts_ = 0;
};

}  // namespace ergodome
