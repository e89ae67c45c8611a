#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "content/timeline/frame_rate.h"

namespace ergodome {

//! Show time in integer nanoseconds: as exact after 1e9 s, where a double has a resolution of 1e-7
//! s, as at the start.
using ShowTime = std::chrono::nanoseconds;

//! Monotonic time from an arbitrary origin.
using MonotonicTime = std::chrono::nanoseconds;
using TimeSource = std::function<MonotonicTime()>;

//! Returns the time of the machine's steady clock.
MonotonicTime steady_time();

//! Rounds seconds to the nearest nanosecond. NaN becomes 0; values are clamped to ±4e9 s.
ShowTime show_time(double seconds);

//! Converts to the nearest double.
double seconds_of(std::chrono::nanoseconds time);

//! Returns the frame shown at a time, counted from 0.
std::int64_t frame_at(ShowTime time, FrameRate rate);

//! Returns the first nanosecond of a frame; frame_at() of it is that frame.
ShowTime time_of_frame(std::int64_t frame, FrameRate rate);

//! A show's clock at one instant.
struct ShowInstant {
  MonotonicTime now{};     //!< when the clock was read
  ShowTime time{};         //!< show time
  std::int64_t frame = 0;  //!< frame of the show, from 0
  std::int64_t pass = 0;   //!< loop restarts since the last jump, negative if played backward
  double speed = 0.0;      //!< show seconds per second; 0: paused
  bool playing = false;
  long jumps = 0;  //!< number of jumps of the show time: seeks, restarts at an end, other versions of the show
};

//! The time of a show.
//!
//! It equals the time at the last change plus the elapsed time multiplied by the speed, in fixed
//! point. Nothing accumulates from frame to frame, so a stall drops frames but never delays the
//! show, and only the result is rounded. A show of duration 0 is static, and its clock keeps
//! running.
class ShowClock {
 public:
  ShowClock(double duration_s, double frame_rate_hz, TimeSource source = steady_time);

  void play();
  void pause();
  //! Jumps to a show time; limited to the show.
  void seek(ShowTime time);
  //! Jumps by a difference: wraps around in a loop, otherwise limited to the show.
  void seek_by(ShowTime difference);
  //! Jumps by a number of frames, to the start of a frame, and pauses.
  void step(std::int64_t frames);
  //! Sets the speed, a factor from -1000 to 1000 with a resolution of 2^-32. Ignores NaN.
  void set_speed(double speed);
  void set_loop(bool loop);
  //! Replaces the show by another version. Keeps the speed, and the time within the new duration.
  void set_show(double duration_s, double frame_rate_hz);

  //! Returns the current instant. Without a loop, stops at the ends.
  ShowInstant read();

  //! Records that the picture of an instant was shown. Frames skipped since the last one count as
  //! dropped, unless the time was set in between.
  void note_shown(const ShowInstant& instant);
  [[nodiscard]] long dropped_frames() const { return dropped_frames_; }

  [[nodiscard]] bool playing() const { return playing_; }
  [[nodiscard]] bool loop() const { return loop_; }
  [[nodiscard]] double speed() const;
  [[nodiscard]] ShowTime duration() const { return duration_; }
  [[nodiscard]] FrameRate rate() const { return rate_; }
  [[nodiscard]] MonotonicTime now() const { return source_(); }

 private:
  //! Fixed-point time in units of 2^-32 ns.
  __extension__ using Fixed = __int128;

  [[nodiscard]] static Fixed fixed(ShowTime time) { return Fixed{time.count()} * (Fixed{1} << 32U); }
  //! Advances the position to `now` if the show plays, in a loop or up to its ends.
  void anchor(MonotonicTime now);
  //! Sets the time, limited to the show; in a loop, its end becomes its start. Counts as a jump.
  void jump(ShowTime time);
  void stop_at_ends();
  [[nodiscard]] std::int64_t frames_a_pass() const;
  [[nodiscard]] ShowTime time() const;

  TimeSource source_;
  ShowTime duration_{};
  FrameRate rate_;
  bool playing_ = false;
  bool loop_ = true;
  std::int64_t speed_ = std::int64_t{1} << 32U;  //!< speed in units of 2^-32
  MonotonicTime anchored_at_{};
  Fixed position_ = 0;     //!< position at anchored_at_, within the show
  std::int64_t pass_ = 0;  //!< number of the pass through the show at anchored_at_
  long jumps_ = 0;

  long dropped_frames_ = 0;
  long shown_jumps_ = -1;
  std::int64_t shown_index_ = 0;  //!< frame shown last, plus the frames of the passes since the last jump
};

}  // namespace ergodome
