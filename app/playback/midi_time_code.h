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

//! How a time code counts frames, as MIDI numbers them. `drop` is 29.97 frames a second, whose counting leaves out two numbers in
//! most minutes.
enum class CodeRate { fps24, fps25, drop, fps30 };

//! A label of one frame: hours, minutes, seconds, frames.
struct TimeCode {
  int hours = 0;
  int minutes = 0;
  int seconds = 0;
  int frames = 0;
  CodeRate rate = CodeRate::fps25;

  bool operator==(const TimeCode&) const = default;
};

//! Whether there is such a label: within its ranges, and none that drop frame counting leaves out.
bool is_valid(const TimeCode& code);

//! Frames from 00:00:00:00 to a valid code.
std::int64_t frame_number(const TimeCode& code);

//! What a code's frames run at: 24, 25, 30000/1001, 30.
FrameRate frame_rate_of(CodeRate rate);

//! Reads "01:00:00:00"; 24 hours at most. Nothing where that is no valid label.
std::optional<TimeCode> parse_time_code(std::string_view text, CodeRate rate);

//! Reads MIDI time code out of a stream of bytes: quarter frames and full frame messages, between whatever else is sent, forth and back.
//!
//! MIDI 1.0 Detailed Specification, MIDI time code (RP-004, RP-008). Eight quarter frames make a code, which is that of the frame in
//! which the first of them (the last, backwards) was sent; so piece k of a code stands for a quarter of k frames more.
//!
//! Some senders do not hold a code while they send it: where a second ends, its pieces are of two frames, and it is wrong by a second, a
//! minute or an hour. So one code that does not follow from those before it is passed over; the next one is taken as it is.
class MidiTimeCodeReader {
 public:
  //! A place of the time code that bytes told.
  struct Reading {
    std::int64_t quarter_frames = 0;  //!< since 00:00:00:00
    CodeRate rate = CodeRate::fps25;
    int direction = 0;  //!< 1 runs, -1 runs backwards, 0: a full frame message put it there

    bool operator==(const Reading&) const = default;
  };

  //! The readings that more bytes complete, in order.
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
  std::vector<std::uint8_t> exclusive_;  //!< of a system exclusive message, up to the longest that is of interest

  std::array<std::uint8_t, 8> pieces_{};
  int piece_ = -1;                     //!< that came last; -1: none
  int direction_ = 0;                  //!< of the pieces
  int in_row_ = 0;                     //!< pieces that came one after the other, up to the eight of a code
  std::optional<std::int64_t> code_;   //!< frames of the code whose pieces are coming, from the one before
  std::optional<std::int64_t> place_;  //!< frames of the last code or full frame message that was believed
  bool doubted_ = false;               //!< the last code did not follow from those before it
  CodeRate rate_ = CodeRate::fps25;
};

//! Turns readings of a time code and when they came into fixes: a straight line through the last second of them, so that the jitter of a
//! cable or a driver does not reach the picture.
class TimeCodeFilter {
 public:
  //! `start` is the time code at which the show's time is 0.
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
