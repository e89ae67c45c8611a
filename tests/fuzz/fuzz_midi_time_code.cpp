#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "app/playback/midi_time_code.h"

// The input is any data from a MIDI cable. Time codes stay within a day (plus the two frames by
// which the last code is extrapolated), and the filter converts them to times that a clock can
// follow.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ergodome;
  MidiTimeCodeReader reader;
  TimeCodeFilter filter(size > 0 && data[0] % 2 == 0 ? std::optional(TimeCode{1, 0, 0, 0, CodeRate::fps25})
                                                     : std::nullopt);
  ShowClock clock(60.0, 30.0, [] { return MonotonicTime(std::chrono::hours(1)); });
  ClockChaser chaser;
  MonotonicTime now{};
  for (const std::uint8_t& byte : std::span(data, size)) {
    now += std::chrono::milliseconds(byte % 16);
    for (const MidiTimeCodeReader::Reading& reading : reader.read(std::span(&byte, 1))) {
      constexpr std::int64_t quarters_a_day = std::int64_t{24} * 3600 * 30 * 4;
      if (reading.quarter_frames < -8 || reading.quarter_frames > quarters_a_day + 8) {
        std::abort();
      }
      const ClockFix fix = filter.filter(reading, now);
      if (std::chrono::abs(fix.show_time) > std::chrono::hours(49)) {
        std::abort();
      }
      chaser.follow(clock, fix, std::chrono::hours(2));
      const ShowInstant instant = clock.read();
      if (instant.time < ShowTime{} || instant.time > clock.duration()) {
        std::abort();
      }
    }
  }
  return 0;
}
