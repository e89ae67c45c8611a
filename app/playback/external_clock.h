#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/playback/show_clock.h"

namespace ergodome {

//! Show time as received from another machine.
struct ClockFix {
  ShowTime show_time{};
  double speed = 1.0;        //!< show seconds in a second; 0: it stands there, until it says otherwise
  MonotonicTime right_at{};  //!< when the show's time was that one, by the clock that the show's own clock runs by
  MonotonicTime heard{};     //!< when its word came, by the same: silence is counted from here
};

//! A clock that the show follows: a receiving thread posts fixes, the player reads them.
class ExternalClock {
 public:
  //! `name` is for people ("MIDI time code"). `patience`: how long a fix that runs is believed without another one.
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
  std::chrono::nanoseconds jump = std::chrono::milliseconds(100);  //!< errors beyond this are jumped over
  std::chrono::nanoseconds slew = std::chrono::milliseconds(500);  //!< smaller ones fall to 1/e in this time
  double most_slew = 0.1;                                          //!< greatest change of speed for it, as a part
};

//! State of following a clock: nothing received yet; following; running on alone for a moment; stopped because nothing
//! arrives any more.
enum class ChaseState { waiting, following, freewheeling, held };

//! Makes a show's clock follow another one.
class ClockChaser {
 public:
  explicit ClockChaser(ChaseSettings settings = {}) : settings_(settings) {}

  //! Once a frame, before the clock is read. After half of `patience` without a word the clock is said to run freely.
  ChaseState follow(ShowClock& clock, const std::optional<ClockFix>& fix, std::chrono::nanoseconds patience);

 private:
  void follow_running(ShowClock& clock, const ClockFix& fix) const;

  ChaseSettings settings_;
};

}  // namespace ergodome
