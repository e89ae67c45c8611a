#include "app/playback/external_clock.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Returns the difference from the show's time to the external clock's: in a loop, the shorter way
//! around; otherwise after clamping the external time to the show.
ShowTime error_of(const ShowClock& clock, ShowTime own, ShowTime other) {
  const ShowTime duration = clock.duration();
  if (duration <= ShowTime{}) {
    return std::max(other, ShowTime{}) - own;
  }
  if (!clock.loop()) {
    return std::clamp(other, ShowTime{}, duration) - own;
  }
  ShowTime error = (other - own) % duration;
  if (error > duration / 2) {
    error -= duration;
  } else if (error < -duration / 2) {
    error += duration;
  }
  return error;
}

}  // namespace

ChaseState ClockChaser::follow(ShowClock& clock, const std::optional<ClockFix>& fix,
                               std::chrono::nanoseconds patience) {
  if (!fix) {
    if (clock.playing()) {
      clock.pause();
    }
    return ChaseState::waiting;
  }
  if (fix->speed == 0.0) {
    if (clock.playing()) {
      clock.pause();
    }
    const ShowTime error = error_of(clock, clock.read().time, fix->show_time);
    if (error != ShowTime{}) {
      clock.seek_by(error);
    }
    return ChaseState::following;
  }
  const auto silence = clock.now() - fix->heard;
  if (silence > patience) {
    if (clock.playing()) {
      clock.pause();
    }
    return ChaseState::held;
  }
  follow_running(clock, *fix);
  return silence > patience / 2 ? ChaseState::freewheeling : ChaseState::following;
}

void ClockChaser::follow_running(ShowClock& clock, const ClockFix& fix) const {
  const ShowInstant own = clock.read();
  const auto since = ShowTime(std::llround(static_cast<double>((own.now - fix.right_at).count()) * fix.speed));
  const ShowTime error = error_of(clock, own.time, fix.show_time + since);
  double speed = fix.speed;
  if (std::chrono::abs(error) > settings_.jump || !own.playing) {
    if (error != ShowTime{}) {
      clock.seek_by(error);
    }
  } else {
    const double maximum = settings_.max_slew * std::abs(fix.speed);
    speed += std::clamp(seconds_of(error) / seconds_of(settings_.slew), -maximum, maximum);
  }
  clock.set_speed(speed);
  const bool at_end = !clock.loop() && clock.duration() > ShowTime{} &&
                      (fix.speed > 0.0 ? clock.read().time >= clock.duration() : clock.read().time <= ShowTime{});
  if (!own.playing && !at_end) {
    clock.play();
  }
}

}  // namespace ergodome
