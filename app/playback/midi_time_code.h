#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/playback/external_clock.h"

namespace ergodome {

//! Frame counting of a time code, numbered as in MIDI. `drop` is 29.97 frames per second and skips
//! two numbers in most minutes.
enum class CodeRate { fps24, fps25, drop, fps30 };

//! The label of a frame: hours, minutes, seconds, frames.
struct TimeCode {
  int hours = 0;
  int minutes = 0;
  int seconds = 0;
  int frames = 0;
  CodeRate rate = CodeRate::fps25;

  bool operator==(const TimeCode&) const = default;
};

//! Returns whether the label exists: within its ranges, and not skipped by drop frame counting.
bool is_valid(const TimeCode& code);

//! Returns the number of frames from 00:00:00:00 to a valid code.
std::int64_t frame_number(const TimeCode& code);

//! Returns the frame rate of a code: 24, 25, 30000/1001 or 30.
FrameRate frame_rate_of(CodeRate rate);

//! Parses a label such as "01:00:00:00", before 24 hours. Returns nothing for an invalid label.
std::optional<TimeCode> parse_time_code(std::string_view text, CodeRate rate);

//! Reads MIDI time code from a stream of bytes: quarter frames and full frame messages between
//! other messages, forward and backward.
//!
//! Source: MIDI 1.0 Detailed Specification, MIDI time code (RP-004, RP-008). Eight quarter frames
//! make a code. It belongs to the frame in which the first of them (backward: the last) was sent,
//! so piece k of a code is k quarter frames later.
//!
//! Some senders change the code while they send it: at the end of a second, its pieces belong to
//! two frames, and it is wrong by a second, a minute or an hour. Therefore a single code that does
//! not follow from those before is ignored; the next one is accepted.
class MidiTimeCodeReader {
 public:
  //! A position of the time code.
  struct Reading {
    std::int64_t quarter_frames = 0;  //!< number of quarter frames since 00:00:00:00
    CodeRate rate = CodeRate::fps25;
    int direction = 0;  //!< 1: forward, -1: backward, 0: set by a full frame message

    bool operator==(const Reading&) const = default;
  };

  //! Reads more bytes and returns the readings that they complete, in order.
  std::vector<Reading> read(std::span<const std::uint8_t> bytes);

 private:
  std::optional<Reading> read_byte(std::uint8_t byte);
  std::optional<Reading> read_quarter(std::uint8_t data);
  std::optional<Reading> read_full_frame();
  std::optional<Reading> finish_code();
  [[nodiscard]] bool follows_from_the_codes_before(std::int64_t code, CodeRate rate) const;
  void lose_code();

  static constexpr std::size_t longest_message = 16;
  bool awaits_quarter_ = false;
  bool in_exclusive_ = false;
  //! Bytes of a system exclusive message, up to the maximum length needed.
  std::vector<std::uint8_t> exclusive_;

  std::array<std::uint8_t, 8> pieces_{};
  int piece_ = -1;  //!< number of the last received piece of a code, 0 to 7; -1: none
  //! 1: pieces arrive in increasing order; -1: in decreasing order; 0: unknown.
  int direction_ = 0;
  int in_row_ = 0;  //!< consecutive pieces, up to the eight of a code
  //! Frame number of the code that is being received, computed from the code before.
  std::optional<std::int64_t> code_;
  //! Frame number of the last accepted code or full frame message.
  std::optional<std::int64_t> position_;
  bool doubted_ = false;  //!< the last complete code did not follow from those before; the next one is accepted anyway
  CodeRate rate_ = CodeRate::fps25;
};

//! Converts readings of a time code and their arrival times to fixes: a straight line through the
//! last second of them removes the jitter of cables and drivers.
class TimeCodeFilter {
 public:
  //! `start` is the time code at which the show's time is 0; absent: midnight.
  explicit TimeCodeFilter(std::optional<TimeCode> start = std::nullopt) : start_(start) {}

  ClockFix filter(const MidiTimeCodeReader::Reading& reading, MonotonicTime received);

 private:
  struct Point {
    MonotonicTime received{};
    ShowTime time{};
  };
  [[nodiscard]] ClockFix line(double usual_speed) const;

  std::optional<TimeCode> start_;
  std::deque<Point> points_;
  int direction_ = 0;
  CodeRate rate_ = CodeRate::fps25;
};

}  // namespace ergodome
