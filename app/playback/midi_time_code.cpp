#include "app/playback/midi_time_code.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

constexpr std::uint8_t exclusive_start = 0xF0;
constexpr std::uint8_t quarter_frame = 0xF1;
constexpr std::uint8_t exclusive_end = 0xF7;
constexpr std::uint8_t first_realtime = 0xF8;

int frames_a_second(CodeRate rate) {
  constexpr int counts[] = {24, 25, 30, 30};
  return counts[static_cast<int>(rate)];
}

std::int64_t frames_a_day(CodeRate rate) {
  // Drop frame counting skips 108 frame numbers per hour.
  return 24 * (std::int64_t{3600} * frames_a_second(rate) - (rate == CodeRate::drop ? 108 : 0));
}

CodeRate rate_of_bits(int bits) { return static_cast<CodeRate>(bits & 3); }

}  // namespace

bool is_valid(const TimeCode& code) {
  const auto within = [](int value, int end) { return value >= 0 && value < end; };
  if (!within(code.hours, 24) || !within(code.minutes, 60) || !within(code.seconds, 60) ||
      !within(code.frames, frames_a_second(code.rate))) {
    return false;
  }
  const bool left_out = code.rate == CodeRate::drop && code.frames < 2 && code.seconds == 0 && code.minutes % 10 != 0;
  return !left_out;
}

std::int64_t frame_number(const TimeCode& code) {
  const std::int64_t minutes = std::int64_t{60} * code.hours + code.minutes;
  const std::int64_t labels = (60 * minutes + code.seconds) * frames_a_second(code.rate) + code.frames;
  return code.rate == CodeRate::drop ? labels - 2 * (minutes - minutes / 10) : labels;
}

FrameRate frame_rate_of(CodeRate rate) {
  constexpr FrameRate rates[] = {{24, 1}, {25, 1}, {30000, 1001}, {30, 1}};
  return rates[static_cast<int>(rate)];
}

std::optional<TimeCode> parse_time_code(std::string_view text, CodeRate rate) {
  int numbers[4] = {};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int i = 0; i < 4; ++i) {
    if (i > 0) {
      if (at == end || (*at != ':' && *at != ';')) {
        return std::nullopt;
      }
      ++at;
    }
    const auto [stop, problem] = std::from_chars(at, end, numbers[i]);
    if (problem != std::errc{}) {
      return std::nullopt;
    }
    at = stop;
  }
  const TimeCode code = {numbers[0], numbers[1], numbers[2], numbers[3], rate};
  return at == end && is_valid(code) ? std::optional(code) : std::nullopt;
}

std::vector<MidiTimeCodeReader::Reading> MidiTimeCodeReader::read(std::span<const std::uint8_t> bytes) {
  std::vector<Reading> readings;
  for (const std::uint8_t byte : bytes) {
    if (const auto reading = read_byte(byte)) {
      readings.push_back(*reading);
    }
  }
  return readings;
}

std::optional<MidiTimeCodeReader::Reading> MidiTimeCodeReader::read_byte(std::uint8_t byte) {
  if (byte >= first_realtime) {
    return std::nullopt;  // a real-time message, which may occur within any other message
  }
  if (byte < 0x80) {
    if (in_exclusive_) {
      if (exclusive_.size() < longest_message) {
        exclusive_.push_back(byte);
      }
      return std::nullopt;
    }
    // Quarter frames have no running status: ignores further data bytes without a status byte.
    return std::exchange(awaits_quarter_, false) ? read_quarter(byte) : std::nullopt;
  }
  const bool ends_exclusive = in_exclusive_ && byte == exclusive_end;
  awaits_quarter_ = byte == quarter_frame;
  in_exclusive_ = byte == exclusive_start;
  const auto reading = ends_exclusive ? read_full_frame() : std::nullopt;
  exclusive_.clear();
  return reading;
}

void MidiTimeCodeReader::lose_code() {
  piece_ = -1;
  in_row_ = 0;
  direction_ = 0;
  code_.reset();
}

std::optional<MidiTimeCodeReader::Reading> MidiTimeCodeReader::read_quarter(std::uint8_t data) {
  const int piece = data >> 4U;
  const int step = piece_ < 0 ? 0 : piece == (piece_ + 1) % 8 ? 1 : piece_ == (piece + 1) % 8 ? -1 : 0;
  if (step == 0 || (direction_ != 0 && step != direction_)) {
    // A piece was lost or the tape reversed, so the code so far is invalid.
    lose_code();
  }
  direction_ = in_row_ > 0 ? step : 0;
  pieces_[static_cast<std::size_t>(piece)] = data & 0x0FU;
  piece_ = piece;
  in_row_ = std::min(in_row_ + 1, 8);
  if (direction_ == 0) {
    return std::nullopt;
  }
  const int first = direction_ > 0 ? 0 : 7;
  const int last = 7 - first;
  if (piece == first && code_) {
    // Eight quarter frames make a code and span two frames, so the next code is two frames later.
    const std::int64_t day = frames_a_day(rate_);
    *code_ = (*code_ + 2 * direction_ + day) % day;
  }
  if (piece == last && in_row_ >= 8) {
    return finish_code();
  }
  if (!code_) {
    return std::nullopt;
  }
  return Reading{4 * *code_ + piece, rate_, direction_};
}

std::optional<MidiTimeCodeReader::Reading> MidiTimeCodeReader::finish_code() {
  const auto number = [&](std::size_t low) { return pieces_[low] | pieces_[low + 1] << 4; };
  const TimeCode code = {number(6) & 0x1F, number(4) & 0x3F, number(2) & 0x3F, number(0) & 0x1F,
                         rate_of_bits(number(6) >> 5)};
  const bool valid = is_valid(code);
  const bool expected = valid && follows_from_the_codes_before(frame_number(code), code.rate);
  const bool passed_over = !expected && !doubted_;
  doubted_ = !expected;
  if (!passed_over && !valid) {
    lose_code();
  } else if (!passed_over) {
    code_ = frame_number(code);
    rate_ = code.rate;
    position_ = code_;
  }
  return code_ ? std::optional(Reading{4 * *code_ + piece_, rate_, direction_}) : std::nullopt;
}

bool MidiTimeCodeReader::follows_from_the_codes_before(std::int64_t code, CodeRate rate) const {
  if (code_) {
    return code == *code_ && rate == rate_;
  }
  // Between two runs of quarter frames the tape may have moved a little; wrong codes deviate by
  // more.
  return !position_ || (rate == rate_ && 2 * std::abs(code - *position_) < frames_a_second(rate));
}

std::optional<MidiTimeCodeReader::Reading> MidiTimeCodeReader::read_full_frame() {
  // F0 7F DEVICE 01 01 HOURS MINUTES SECONDS FRAMES F7: a universal real-time message. It is
  // accepted whatever DEVICE is.
  if (exclusive_.size() != 8 || exclusive_[0] != 0x7F || exclusive_[2] != 0x01 || exclusive_[3] != 0x01) {
    return std::nullopt;
  }
  const TimeCode code = {exclusive_[4] & 0x1F, exclusive_[5], exclusive_[6], exclusive_[7],
                         rate_of_bits(exclusive_[4] >> 5)};
  if (!is_valid(code)) {
    return std::nullopt;
  }
  lose_code();
  rate_ = code.rate;
  position_ = frame_number(code);
  doubted_ = false;
  return Reading{4 * *position_, code.rate, 0};
}

ClockFix TimeCodeFilter::filter(const MidiTimeCodeReader::Reading& reading, MonotonicTime received) {
  const FrameRate rate = frame_rate_of(reading.rate);
  std::int64_t quarters = reading.quarter_frames;
  if (start_) {
    TimeCode start = *start_;
    start.rate = reading.rate;
    quarters -= 4 * frame_number(start);
  }
  // The time code wraps at midnight, but a show that runs through midnight continues.
  const std::int64_t half_day = 2 * frames_a_day(reading.rate);
  quarters = quarters < -half_day ? quarters + 2 * half_day : quarters;
  const ShowTime time = time_of_frame(quarters, {4 * rate.frames, rate.seconds});
  if (reading.direction == 0) {
    points_.clear();
    return {time, 0.0, received, received};
  }
  constexpr auto window = std::chrono::seconds(1);
  constexpr auto tear = std::chrono::milliseconds(100);
  if (!points_.empty()) {
    const auto expected = points_.back().time + reading.direction * (received - points_.back().received);
    if (reading.direction != direction_ || reading.rate != rate_ || std::chrono::abs(time - expected) > tear) {
      points_.clear();
    }
  }
  direction_ = reading.direction;
  rate_ = reading.rate;
  points_.push_back({received, time});
  constexpr std::size_t maximum = 256;
  while (points_.size() > maximum || received - points_.front().received > window) {
    points_.pop_front();
  }
  return line(reading.direction);
}

ClockFix TimeCodeFilter::line(double usual_speed) const {
  const Point& last = points_.back();
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const Point& point : points_) {
    mean_x += seconds_of(point.received - last.received);
    mean_y += seconds_of(point.time - last.time);
  }
  const auto count = static_cast<double>(points_.size());
  mean_x /= count;
  mean_y /= count;
  double xx = 0.0;
  double xy = 0.0;
  for (const Point& point : points_) {
    const double x = seconds_of(point.received - last.received) - mean_x;
    xx += x * x;
    xy += x * (seconds_of(point.time - last.time) - mean_y);
  }
  // A few points determine the position but not the speed, so the nominal speed is used.
  constexpr std::size_t enough = 24;
  const double speed = points_.size() >= enough && xx > 0.0 ? xy / xx : usual_speed;
  return {last.time + show_time(mean_y - speed * mean_x), speed, last.received, last.received};
}

}  // namespace ergodome
