#include "app/playback/clock/show_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t nanoseconds_a_second = 1'000'000'000;

Wide floor_quotient(Wide a, Wide b) { return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0); }

constexpr double fixed_one = 4294967296.0;
constexpr double fastest = 1000.0;

template <class Integer>
Integer floor_quotient(Integer a, Integer b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

}  // namespace

MonotonicTime steady_time() {
  return std::chrono::duration_cast<MonotonicTime>(std::chrono::steady_clock::now().time_since_epoch());
}

ShowTime show_time(double seconds) {
  if (std::isnan(seconds)) {
    return {};
  }
  const double within = std::clamp(seconds, -4e9, 4e9);
  const double whole = std::trunc(within);
  return std::chrono::seconds(static_cast<std::int64_t>(whole)) + ShowTime(std::llround((within - whole) * 1e9));
}

double seconds_of(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) / 1e9; }

std::int64_t frame_at(ShowTime time, FrameRate rate) {
  return static_cast<std::int64_t>(
      floor_quotient(Wide{time.count()} * rate.frames, Wide{rate.seconds} * nanoseconds_a_second));
}

ShowTime time_of_frame(std::int64_t frame, FrameRate rate) {
  const Wide ticks = Wide{frame} * rate.seconds * nanoseconds_a_second;
  return ShowTime(static_cast<std::int64_t>(-floor_quotient(-ticks, rate.frames)));
}

ShowClock::ShowClock(double duration_s, double frame_rate_hz, TimeSource source)
    : source_(std::move(source)),
      duration_(std::max(show_time(duration_s), ShowTime{})),
      rate_(frame_rate_of(frame_rate_hz)),
      anchored_at_(source_()) {}

ShowTime ShowClock::time() const {
  return ShowTime(static_cast<std::int64_t>(floor_quotient(position_, Fixed{1} << 32U)));
}

void ShowClock::anchor(MonotonicTime now) {
  if (playing_) {
    position_ += Fixed{(now - anchored_at_).count()} * speed_;
    const Fixed length = fixed(duration_);
    if (length > 0 && loop_) {
      const Fixed passes = floor_quotient(position_, length);
      position_ -= passes * length;
      pass_ += static_cast<std::int64_t>(passes);
    } else if (length > 0) {
      stop_at_ends();
    } else {
      // Without an end, the only limit is that of ShowTime, about 146 years.
      position_ = std::clamp(position_, Fixed{0}, fixed(ShowTime::max() / 2));
    }
  }
  anchored_at_ = now;
}

void ShowClock::stop_at_ends() {
  const Fixed length = fixed(duration_);
  if ((position_ >= length && speed_ > 0) || (position_ <= 0 && speed_ < 0)) {
    playing_ = false;
  }
  position_ = std::clamp(position_, Fixed{0}, length);
}

void ShowClock::jump(ShowTime time) {
  const ShowTime last = duration_ > ShowTime{} ? duration_ : ShowTime::max() / 2;
  const ShowTime within = std::clamp(time, ShowTime{}, last);
  position_ = fixed(loop_ && within == duration_ ? ShowTime{} : within);
  pass_ = 0;
  ++jumps_;
}

void ShowClock::play() {
  anchor(source_());
  if (!playing_ && duration_ > ShowTime{}) {
    // At an end, playing starts over.
    if (speed_ > 0 && time() >= duration_) {
      jump(ShowTime{});
    } else if (speed_ < 0 && time() <= ShowTime{}) {
      jump(duration_);
    }
  }
  playing_ = true;
}

void ShowClock::pause() {
  anchor(source_());
  playing_ = false;
}

void ShowClock::seek(ShowTime to) {
  anchor(source_());
  jump(to);
}

void ShowClock::seek_by(ShowTime difference) {
  anchor(source_());
  ShowTime to = time() + std::clamp(difference, -ShowTime::max() / 2, ShowTime::max() / 2);
  if (loop_ && duration_ > ShowTime{}) {
    to -= duration_ * floor_quotient(to.count(), duration_.count());
  }
  jump(to);
}

void ShowClock::step(std::int64_t frames) {
  pause();
  constexpr std::int64_t maximum = 1'000'000'000'000;
  std::int64_t to = std::clamp(read().frame + std::clamp(frames, -maximum, maximum), -maximum, maximum);
  if (duration_ > ShowTime{}) {
    const std::int64_t count = frames_a_pass();
    to = loop_ ? to - count * floor_quotient(to, count) : std::clamp<std::int64_t>(to, 0, count - 1);
  }
  jump(time_of_frame(to, rate_));
}

void ShowClock::set_speed(double speed) {
  if (std::isnan(speed)) {
    return;
  }
  anchor(source_());
  speed_ = std::llround(std::clamp(speed, -fastest, fastest) * fixed_one);
}

double ShowClock::speed() const { return static_cast<double>(speed_) / fixed_one; }

void ShowClock::set_loop(bool loop) {
  anchor(source_());
  loop_ = loop;
}

void ShowClock::set_show(double duration_s, double frame_rate_hz) {
  anchor(source_());
  duration_ = std::max(show_time(duration_s), ShowTime{});
  rate_ = frame_rate_of(frame_rate_hz);
  jump(time());
}

std::int64_t ShowClock::frames_a_pass() const { return frame_at(duration_ - ShowTime(1), rate_) + 1; }

ShowInstant ShowClock::read() {
  anchor(source_());
  std::int64_t frame = frame_at(time(), rate_);
  if (duration_ > ShowTime{}) {
    // At the end itself, where a show without a loop stops, the last frame is still shown.
    frame = std::min(frame, frames_a_pass() - 1);
  }
  return {anchored_at_, time(), frame, pass_, playing_ ? speed() : 0.0, playing_, jumps_};
}

void ShowClock::note_shown(const ShowInstant& instant) {
  const std::int64_t index = instant.pass * (duration_ > ShowTime{} ? frames_a_pass() : 0) + instant.frame;
  if (instant.jumps == shown_jumps_) {
    dropped_frames_ += static_cast<long>(std::max<std::int64_t>(std::abs(index - shown_index_) - 1, 0));
  }
  shown_jumps_ = instant.jumps;
  shown_index_ = index;
}

}  // namespace ergodome
