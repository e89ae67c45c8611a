#pragma once

#include "app/playback/show_time.h"

namespace ergodome {

//! A show's clock at one instant.
struct ShowInstant {
  MonotonicTime now{};     //!< when the clock was read
  ShowTime time{};         //!< of the show
  std::int64_t frame = 0;  //!< of the show, from 0
  std::int64_t pass = 0;   //!< how often the show has begun anew by running on, since the last jump
  double speed = 0.0;      //!< show seconds in a second; 0 where it stands
  bool playing = false;
  long jumps = 0;  //!< how often the time was set, and not run to
};

//! The time of a show.
//!
//! It is where the show was when it last was told something, plus the time since then times the speed, in fixed point: nothing is
//! added up from frame to frame, so that a stall of the machine drops frames and never makes the show late, and nothing is
//! rounded but the answer. A show of duration 0 stands still, and its clock runs on.
class ShowClock {
 public:
  ShowClock(double duration_s, double frame_rate_hz, TimeSource source = steady_time);

  void play();
  void pause();
  //! To a time of the show; beyond its ends, to the end.
  void seek(ShowTime time);
  //! Forth and back from here: round in a loop, to the ends otherwise.
  void seek_by(ShowTime difference);
  //! To the start of the frame so many frames from this one; pauses.
  void step(std::int64_t frames);
  //! Any factor from -1000 to 1000, to 2^-32. What is not a number is ignored.
  void set_speed(double speed);
  void set_loop(bool loop);
  //! Another version of the show; time and speed stay.
  void set_show(double duration_s, double frame_rate_hz);

  //! Where the show is now. Without a loop it stops at its ends by itself.
  ShowInstant read();

  //! Says that the picture of an instant was shown: frames since the last one said, whose time went by without, are dropped ones.
  void note_shown(const ShowInstant& instant);
  [[nodiscard]] long dropped_frames() const { return dropped_frames_; }

  [[nodiscard]] bool playing() const { return playing_; }
  [[nodiscard]] bool loop() const { return loop_; }
  [[nodiscard]] double speed() const;
  [[nodiscard]] ShowTime duration() const { return duration_; }
  [[nodiscard]] FrameRate rate() const { return rate_; }
  [[nodiscard]] MonotonicTime now() const { return source_(); }

 private:
  //! Time in 2^-32 ns.
  __extension__ using Fixed = __int128;

  [[nodiscard]] static Fixed fixed(ShowTime time) { return Fixed{time.count()} * (Fixed{1} << 32U); }
  //! From now on time runs from here.
  void anchor(MonotonicTime now);
  //! Puts the time somewhere, within the show.
  void jump(ShowTime time);
  void stop_at_ends();
  [[nodiscard]] std::int64_t frames_a_pass() const;
  [[nodiscard]] ShowTime time() const;

  TimeSource source_;
  ShowTime duration_{};
  FrameRate rate_;
  bool playing_ = false;
  bool loop_ = true;
  std::int64_t speed_ = std::int64_t{1} << 32U;  //!< in 2^-32
  MonotonicTime anchored_at_{};
  Fixed position_ = 0;     //!< at that moment, within the show
  std::int64_t pass_ = 0;  //!< at that moment
  long jumps_ = 0;

  long dropped_frames_ = 0;
  long shown_jumps_ = -1;
  std::int64_t shown_index_ = 0;  //!< frames since the last jump, over all passes
};

}  // namespace ergodome
