#include "app/playback/midi_time_code.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ergodome {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using Reading = MidiTimeCodeReader::Reading;

//! Returns the two bytes of a MIDI quarter-frame message: piece 0 to 7 of a time code.
Bytes quarter(const TimeCode& code, int piece) {
  const int rate = static_cast<int>(code.rate);
  const int nibbles[] = {code.frames & 15,  code.frames >> 4,  code.seconds & 15, code.seconds >> 4,
                         code.minutes & 15, code.minutes >> 4, code.hours & 15,   code.hours >> 4 | rate << 1};
  return {0xF1, static_cast<std::uint8_t>(piece << 4 | nibbles[piece])};
}

Bytes code_forwards(const TimeCode& code) {
  Bytes bytes;
  for (int piece = 0; piece < 8; ++piece) {
    const Bytes two = quarter(code, piece);
    bytes.insert(bytes.end(), two.begin(), two.end());
  }
  return bytes;
}

Bytes code_backwards(const TimeCode& code) {
  Bytes bytes;
  for (int piece = 7; piece >= 0; --piece) {
    const Bytes two = quarter(code, piece);
    bytes.insert(bytes.end(), two.begin(), two.end());
  }
  return bytes;
}

TEST(TimeCode, DropFrameCountingLeavesOutTwoLabelsInMostMinutes) {
  EXPECT_EQ(frame_number({0, 0, 59, 29, CodeRate::drop}), 1799);
  EXPECT_EQ(frame_number({0, 1, 0, 2, CodeRate::drop}), 1800);
  EXPECT_EQ(frame_number({0, 10, 0, 0, CodeRate::drop}), 17982);
  EXPECT_EQ(frame_number({1, 0, 0, 0, CodeRate::drop}), 107892);
  EXPECT_FALSE(is_valid({0, 1, 0, 0, CodeRate::drop}));
  EXPECT_TRUE(is_valid({0, 10, 0, 0, CodeRate::drop}));
}

TEST(TimeCode, IsReadFromText) {
  EXPECT_EQ(parse_time_code("01:02:03:04", CodeRate::fps25), (TimeCode{1, 2, 3, 4, CodeRate::fps25}));
  for (const char* const text :
       {"", "1", "01:02:03", "01:02:03:25", "24:00:00:00", "01:02:03:04x", "-1:0:0:0", "::::"}) {
    EXPECT_FALSE(parse_time_code(text, CodeRate::fps25)) << text;
  }
}

TEST(MidiTimeCode, EightQuarterFramesMakeACodeThatIsSevenQuartersOld) {
  MidiTimeCodeReader reader;
  const TimeCode code = {12, 34, 56, 23, CodeRate::fps24};
  EXPECT_THAT(reader.read(code_forwards(code)),
              testing::ElementsAre(Reading{4 * frame_number(code) + 7, CodeRate::fps24, 1}));
}

TEST(MidiTimeCode, EveryFurtherQuarterTellsAPlace) {
  MidiTimeCodeReader reader;
  reader.read(code_forwards({1, 0, 0, 0, CodeRate::fps25}));
  const auto readings = reader.read(code_forwards({1, 0, 0, 2, CodeRate::fps25}));
  ASSERT_EQ(readings.size(), 8U);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_EQ(readings[i].quarter_frames, 4 * (3600 * 25 + 2) + static_cast<std::int64_t>(i));
  }
}

TEST(MidiTimeCode, RunsBackwards) {
  MidiTimeCodeReader reader;
  EXPECT_THAT(reader.read(code_backwards({1, 0, 0, 2, CodeRate::fps30})),
              testing::ElementsAre(Reading{4 * (3600 * 30 + 2), CodeRate::fps30, -1}));
  const auto readings = reader.read(code_backwards({1, 0, 0, 0, CodeRate::fps30}));
  ASSERT_EQ(readings.size(), 8U);
  EXPECT_EQ(readings.front().quarter_frames, 4 * 3600 * 30 + 7);
  EXPECT_EQ(readings.back().quarter_frames, 4 * 3600 * 30);
}

TEST(MidiTimeCode, ATapeThatTurnsRoundIsUnknownUntilAWholeCodeHasCome) {
  MidiTimeCodeReader reader;
  const TimeCode code = {1, 0, 0, 4, CodeRate::fps25};
  reader.read(code_forwards({1, 0, 0, 2, CodeRate::fps25}));
  for (const int piece : {0, 1, 2}) {
    EXPECT_EQ(reader.read(quarter(code, piece)).size(), 1U);
  }
  for (const int piece : {1, 0}) {
    EXPECT_TRUE(reader.read(quarter(code, piece)).empty());
  }
  EXPECT_EQ(reader.read(code_backwards({1, 0, 0, 2, CodeRate::fps25})).size(), 1U);
}

TEST(MidiTimeCode, ALostQuarterIsNotGuessedOver) {
  MidiTimeCodeReader reader;
  Bytes bytes = code_forwards({1, 0, 0, 0, CodeRate::fps25});
  bytes.erase(bytes.begin() + 6, bytes.begin() + 8);
  EXPECT_TRUE(reader.read(bytes).empty());
  EXPECT_EQ(reader.read(code_forwards({1, 0, 0, 2, CodeRate::fps25})).size(), 1U);
}

TEST(MidiTimeCode, AFullFrameMessagePutsItSomewhere) {
  MidiTimeCodeReader reader;
  const Bytes message = {0xF0, 0x7F, 0x7F, 0x01, 0x01, 0x21, 0x02, 0x03, 0x04, 0xF7};  // 01:02:03:04 at 25 frames/s
  EXPECT_THAT(reader.read(message), testing::ElementsAre(Reading{4 * (3723 * 25 + 4), CodeRate::fps25, 0}));
}

TEST(MidiTimeCode, OtherMessagesAreNotInTheWay) {
  MidiTimeCodeReader reader;
  const TimeCode code = {1, 2, 3, 4, CodeRate::fps25};
  const Bytes plain = code_forwards(code);
  Bytes mixed = {0x90, 0x3C, 0x40};  // a note message
  for (std::size_t i = 0; i < plain.size(); i += 2) {
    // Inserts a MIDI clock tick inside the quarter-frame message, and after the message a note
    // whose second event uses running status.
    mixed.insert(mixed.end(), {plain[i], 0xF8, plain[i + 1], 0x90, 0x3C, 0x00, 0x3D, 0x40});
  }
  EXPECT_EQ(reader.read(mixed), MidiTimeCodeReader().read(plain));
}

TEST(MidiTimeCode, WhatIsNoLabelIsNotRead) {
  MidiTimeCodeReader reader;
  EXPECT_TRUE(reader.read(code_forwards({1, 0, 61, 0, CodeRate::fps25})).empty());
  EXPECT_TRUE(reader.read(code_forwards({1, 1, 0, 0, CodeRate::drop})).empty());
  EXPECT_TRUE(reader.read(Bytes{0xF0, 0x7F, 0x7F, 0x01, 0x01, 0x3F, 0x7F, 0x7F, 0x7F, 0xF7}).empty());
  EXPECT_TRUE(reader.read(Bytes{0xF0, 0x7F, 0x7F, 0x01, 0x01, 0x21, 0x02, 0x03, 0xF7}).empty()) << "too short";
  EXPECT_TRUE(reader.read(Bytes{0xF0, 0x7E, 0x7F, 0x01, 0x01, 0x21, 0x02, 0x03, 0x04, 0xF7}).empty())
      << "not real time";
}

//! Returns the time code of the next frame; drop-frame codes skip labels that do not exist.
TimeCode next_label(TimeCode code) {
  do {
    const int frames = code.rate == CodeRate::fps24 ? 24 : code.rate == CodeRate::fps25 ? 25 : 30;
    code.frames = (code.frames + 1) % frames;
    code.seconds = (code.seconds + (code.frames == 0 ? 1 : 0)) % 60;
    code.minutes = (code.minutes + (code.frames == 0 && code.seconds == 0 ? 1 : 0)) % 60;
    code.hours = (code.hours + (code.frames == 0 && code.seconds == 0 && code.minutes == 0 ? 1 : 0)) % 24;
  } while (!is_valid(code));
  return code;
}

//! A stream of quarter-frame messages. Message 0 belongs to the frame with the time code `first`.
struct Stream {
  TimeCode first;
  int quarters;
  int step = 1;
  //! If true, the eight messages of a code all describe the frame at its start. If false, each
  //! describes the frame that is current when it is sent, as some senders do.
  bool holds_codes = true;

  //! Reads the stream from message `from` on (counted from the end if backwards). Returns each
  //! reading and the true number of its message.
  [[nodiscard]] std::vector<std::pair<Reading, std::int64_t>> read(int from = 0) const {
    std::vector<TimeCode> labels = {first};
    while (static_cast<int>(labels.size()) <= quarters / 4) {
      labels.push_back(next_label(labels.back()));
    }
    MidiTimeCodeReader reader;
    std::vector<std::pair<Reading, std::int64_t>> readings;
    for (int i = from; i < quarters; ++i) {
      const int at = step > 0 ? i : quarters - 1 - i;
      const auto label = static_cast<std::size_t>(holds_codes ? at / 8 * 2 : at / 4);
      for (const Reading& reading : reader.read(quarter(labels[label], at % 8))) {
        readings.emplace_back(reading, 4 * frame_number(first) + at);
      }
    }
    return readings;
  }
};

const TimeCode ends_of_minutes[] = {
    {0, 0, 58, 0, CodeRate::fps24},   {0, 0, 58, 1, CodeRate::fps24},   {0, 59, 58, 0, CodeRate::fps25},
    {0, 59, 58, 1, CodeRate::fps25},  {0, 59, 58, 4, CodeRate::drop},   {0, 59, 58, 5, CodeRate::drop},
    {0, 0, 58, 4, CodeRate::drop},    {0, 0, 58, 5, CodeRate::drop},    {1, 9, 58, 3, CodeRate::drop},
    {12, 34, 58, 6, CodeRate::fps30}, {12, 34, 58, 7, CodeRate::fps30}, {9, 59, 58, 3, CodeRate::fps30}};

TEST(MidiTimeCode, StreamsOfAllRatesAreReadFromTheMiddleForthAndBack) {
  for (const TimeCode& first : ends_of_minutes) {
    for (const int step : {1, -1}) {
      const auto readings = Stream{first, 480, step}.read(3);
      // Reading starts with message 3. The first complete code ends after the five remaining
      // messages of the current code and the eight of the next.
      ASSERT_EQ(readings.size(), 480U - 3U - 5U - 7U);
      for (const auto& [reading, truth] : readings) {
        ASSERT_EQ(reading, (Reading{truth, first.rate, step})) << frame_number(first);
      }
    }
  }
}

TEST(MidiTimeCode, ACodeOfTwoFramesAtTheEndOfAMinuteDoesNotMoveTheShow) {
  int wrong_streams = 0;
  for (const TimeCode& first : ends_of_minutes) {
    for (const int step : {1, -1}) {
      const Stream faulty = {first, 480, step, false};
      const auto readings = faulty.read();
      ASSERT_EQ(readings.size(), 480U - 7U);
      for (const auto& [reading, truth] : readings) {
        ASSERT_EQ(reading, (Reading{truth, first.rate, step})) << frame_number(first);
      }
      // Checks that the faulty stream is a real test: single codes, each read by a new reader, are
      // sometimes wrong.
      for (int begin = 0; begin + 8 <= 480; begin += 8) {
        const Stream one = {first, step > 0 ? begin + 8 : 480 - begin, step, false};
        const auto alone = one.read(step > 0 ? begin : 0);
        wrong_streams += !alone.empty() && alone.front().first.quarter_frames != alone.front().second ? 1 : 0;
      }
    }
  }
  EXPECT_GT(wrong_streams, 4) << "the fault is there";
}

TEST(MidiTimeCode, AJumpWithoutAWordBeforeIsFollowedFromItsSecondCodeOn) {
  MidiTimeCodeReader reader;
  reader.read(code_forwards({1, 0, 0, 0, CodeRate::fps25}));
  reader.read(code_forwards({1, 0, 0, 2, CodeRate::fps25}));
  EXPECT_EQ(reader.read(code_forwards({2, 0, 0, 0, CodeRate::fps25})).back().quarter_frames, 4 * (3600 * 25 + 4) + 7);
  EXPECT_EQ(reader.read(code_forwards({2, 0, 0, 2, CodeRate::fps25})).back().quarter_frames, 4 * (7200 * 25 + 2) + 7);
  // While a sender fast-forwards, consecutive codes differ by more than two frames.
  EXPECT_EQ(reader.read(code_forwards({2, 0, 1, 0, CodeRate::fps25})).back().quarter_frames, 4 * 7201 * 25 + 7);
  EXPECT_EQ(reader.read(code_forwards({2, 0, 2, 0, CodeRate::fps25})).back().quarter_frames, 4 * 7202 * 25 + 7);
}

TEST(MidiTimeCode, AFirstCodeAfterAStopIsCheckedAgainstTheLastPlace) {
  MidiTimeCodeReader reader;
  reader.read(Bytes{0xF0, 0x7F, 0x7F, 0x01, 0x01, 0x20, 0x3B, 0x3B, 0x18, 0xF7});  // 00:59:59:24 at 25 frames/s
  // The first quarter frames after the stop contain the hours of the following frame, 1, instead of
  // 0.
  EXPECT_TRUE(reader.read(code_forwards({1, 59, 59, 24, CodeRate::fps25})).empty());
  EXPECT_EQ(reader.read(code_forwards({1, 0, 0, 1, CodeRate::fps25})).back().quarter_frames, 4 * (3600 * 25 + 1) + 7);
}

TEST(MidiTimeCode, RunsThroughMidnight) {
  for (const CodeRate rate : {CodeRate::fps24, CodeRate::fps25, CodeRate::drop, CodeRate::fps30}) {
    MidiTimeCodeReader reader;
    const TimeCode last = {23, 59, 59, rate == CodeRate::fps24 ? 22 : rate == CodeRate::fps25 ? 23 : 28, rate};
    reader.read(code_forwards(last));
    const auto readings = reader.read(code_forwards({0, 0, 0, 0, rate}));
    ASSERT_EQ(readings.size(), 8U);
    EXPECT_EQ(readings.front().quarter_frames, 0);
    EXPECT_EQ(readings.back().quarter_frames, 7);
    EXPECT_EQ(reader.read(code_backwards({0, 0, 0, 0, rate})).size(), 1U) << "turned round";
    EXPECT_EQ(reader.read(code_backwards(last)).front().quarter_frames, 4 * frame_number(last) + 7);
  }
}

//! A simulated sender that plays at a constant speed; its messages arrive late by up to `jitter_s`.
struct Machine {
  CodeRate rate;
  double speed;
  double jitter_s;

  //! Feeds the machine's messages to the filter for some seconds. Returns the maximum error of the
  //! clock fixes after the first 16 messages.
  double max_error_s(TimeCodeFilter& filter, double seconds) const {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> late_s(0.0, jitter_s);
    const FrameRate frames = frame_rate_of(rate);
    const double quarter_s = static_cast<double>(frames.seconds) / (4.0 * static_cast<double>(frames.frames));
    double worst_s = 0.0;
    for (int i = 0; i * quarter_s < seconds; ++i) {
      const double sent_s = i * quarter_s / speed;
      const ClockFix fix = filter.filter({i, rate, 1}, show_time(sent_s + late_s(random)));
      // A filter can only correct for the mean delay of the messages.
      const double truth_s = speed * (seconds_of(fix.right_at) - jitter_s / 2.0);
      if (i > 16) {
        worst_s = std::max(worst_s, std::abs(seconds_of(fix.show_time) - truth_s));
      }
    }
    return worst_s;
  }
};

TEST(TimeCodeFilter, JitterIsAveragedAway) {
  TimeCodeFilter filter;
  EXPECT_LT((Machine{CodeRate::fps25, 1.0, 0.004}.max_error_s(filter, 60.0)), 0.0015);
}

TEST(TimeCodeFilter, AMachineThatRunsFastIsFollowed) {
  TimeCodeFilter filter;
  EXPECT_LT((Machine{CodeRate::drop, 1.04, 0.0}.max_error_s(filter, 20.0)), 0.005);
}

TEST(TimeCodeFilter, AnHourOfDropFrameLabelsIsAnHour) {
  TimeCodeFilter filter;
  const ClockFix fix = filter.filter({4 * frame_number({1, 0, 0, 0, CodeRate::drop}), CodeRate::drop, 0}, 0s);
  EXPECT_NEAR(seconds_of(fix.show_time), 3600.0, 0.004) << "107892 * 1001 / 30000 = 3599.9964";
}

TEST(TimeCodeFilter, ASeekOfTheMachineIsTakenAtOnce) {
  TimeCodeFilter filter;
  for (int i = 0; i < 100; ++i) {
    filter.filter({i, CodeRate::fps25, 1}, i * 10ms);
  }
  const ClockFix fix = filter.filter({50'000, CodeRate::fps25, 1}, 1s);
  EXPECT_EQ(fix.show_time, 500s);
  EXPECT_EQ(fix.speed, 1.0);
}

TEST(TimeCodeFilter, AMachineThatStandsHasNoSpeed) {
  TimeCodeFilter filter;
  filter.filter({100, CodeRate::fps25, 1}, 0s);
  EXPECT_EQ(filter.filter({400, CodeRate::fps25, 0}, 1s).speed, 0.0);
}

TEST(TimeCodeFilter, TheShowBeginsAtItsStartCode) {
  TimeCodeFilter filter(TimeCode{1, 0, 0, 0, CodeRate::fps25});
  const std::int64_t quarters = 4 * frame_number({1, 0, 10, 0, CodeRate::fps30});
  EXPECT_EQ(filter.filter({quarters, CodeRate::fps30, 0}, 0s).show_time, 10s) << "whatever rate the code comes in";
}

TEST(TimeCodeFilter, AShowRunsThroughMidnight) {
  TimeCodeFilter filter(TimeCode{23, 0, 0, 0, CodeRate::fps25});
  EXPECT_EQ(filter.filter({4 * 25 * 1800, CodeRate::fps25, 0}, 0s).show_time, 5400s);
}

}  // namespace
}  // namespace ergodome
