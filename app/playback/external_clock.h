#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/playback/clock/show_clock.h"

namespace ergodome {

//! Show time as received from another machine.
struct ClockFix {
  ShowTime show_time{};
  //! Show seconds per second; 0: paused until the clock reports otherwise.
  double speed = 1.0;
  MonotonicTime right_at{};  //!< when the show time was valid, by the same clock as the show's
  //! When the fix arrived, by the same clock; silence is counted from here.
  MonotonicTime heard{};
};

//! A clock that the show follows. A receiving thread posts fixes; the player reads them.
class ExternalClock {
 public:
  //! `name` is for display ("MIDI time code"). `patience` is how long a running fix stays valid
  //! without another one.
  ExternalClock(std::string name, std::chrono::nanoseconds patience) : name_(std::move(name)), patience_(patience) {}

  void post(const ClockFix& fix) {
    const std::lock_guard lock(mutex_);
    fix_ = fix;
  }

  [[nodiscard]] std::optional<ClockFix> latest() const {
    const std::lock_guard lock(mutex_);
    return fix_;
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::chrono::nanoseconds patience() const { return patience_; }

 private:
  std::string name_;
  std::chrono::nanoseconds patience_;
  mutable std::mutex mutex_;
  std::optional<ClockFix> fix_;
};

struct ChaseSettings {
  //! Errors of the show's time above this are corrected at once, by a jump.
  std::chrono::nanoseconds jump = std::chrono::milliseconds(100);
  //! Time constant with which errors up to `jump` are corrected by changing the speed.
  std::chrono::nanoseconds slew = std::chrono::milliseconds(500);
  //! Maximum relative change of speed for such a correction.
  double max_slew = 0.1;
};

//! State of following a clock, in this order: nothing received yet, following, running on alone for
//! a moment, stopped because nothing arrives.
enum class ChaseState { waiting, following, freewheeling, held };

//! Makes a show's clock follow an external one.
class ClockChaser {
 public:
  explicit ClockChaser(ChaseSettings settings = {}) : settings_(settings) {}

  //! Updates the clock; call it once per frame, before the clock is read. Half of `patience` after
  //! the last running fix, the state is freewheeling; after all of it, the clock is paused and the
  //! state is held.
  ChaseState follow(ShowClock& clock, const std::optional<ClockFix>& fix, std::chrono::nanoseconds patience);

 private:
  void follow_running(ShowClock& clock, const ClockFix& fix) const;

  ChaseSettings settings_;
};

}  // namespace ergodome
