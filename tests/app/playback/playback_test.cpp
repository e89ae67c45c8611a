#include "app/playback/playback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/playback/fake_time.h"

namespace ergodome {
namespace {

using namespace std::chrono_literals;
using Kind = TransportCommand::Kind;
using test::FakeTime;

Show show_with_chapters() {
  Show show;
  show.title = {{"", "Once around"}};
  show.duration_s = 60.0;
  show.frame_rate_hz = 30.0;
  show.stereo.baseline = 0.1;
  show.timeline.chapters = {
      {5.0, {{"en", "Outside"}, {"de", "Draußen"}}}, {20.0, {{"en", "Near"}, {"de", "Nah"}}}, {40.0, {{"", "?"}}}};
  show.timeline.audio = {{"text_fr.wav", 0.0, 0.0, 0.0, 0.0, "fr", false}};
  return show;
}

class PlaybackTest : public testing::Test {
 protected:
  CommandOutcome command(Kind kind, double value = 0.0, const std::string& text = "") {
    const CommandOutcome outcome = playback_.apply({kind, value, text});
    playback_.advance();
    return outcome;
  }
  double now_s() {
    playback_.advance();
    return seconds_of(playback_.instant().time);
  }
  PlayerStatus status() {
    PlayerStatus status;
    playback_.advance();
    playback_.fill(status);
    return status;
  }

  FakeTime time_;
  Playback playback_{show_with_chapters(), {"", 1s, time_.source()}};
};

using TransportCommands = PlaybackTest;

TEST_F(TransportCommands, AShowPlaysFromTheBeginning) {
  time_.pass(2.0);
  EXPECT_EQ(now_s(), 2.0);
}

TEST_F(TransportCommands, PauseAndPlay) {
  command(Kind::pause);
  time_.pass(2.0);
  EXPECT_EQ(now_s(), 0.0);
  command(Kind::toggle_pause);
  time_.pass(2.0);
  EXPECT_EQ(now_s(), 2.0);
  command(Kind::toggle_pause);
  EXPECT_FALSE(status().playing);
}

TEST_F(TransportCommands, SeekStepAndSpeed) {
  command(Kind::seek, 30.0);
  EXPECT_EQ(now_s(), 30.0);
  command(Kind::seek_by, -10.0);
  EXPECT_EQ(now_s(), 20.0);
  command(Kind::speed, -2.0);
  time_.pass(5.0);
  EXPECT_EQ(now_s(), 10.0);
  command(Kind::step, 3.0);
  EXPECT_NEAR(now_s(), 10.1, 1e-8);
  EXPECT_FALSE(status().playing);
}

TEST_F(TransportCommands, ChaptersAreKnownByTheTime) {
  EXPECT_EQ(playback_.chapter(), -1);
  command(Kind::seek, 5.0);
  EXPECT_EQ(playback_.chapter(), 0);
  command(Kind::seek, 39.9);
  EXPECT_EQ(playback_.chapter(), 1);
}

TEST_F(TransportCommands, ChaptersAreGoneTo) {
  command(Kind::chapter, 1.0);
  EXPECT_EQ(now_s(), 20.0);
  command(Kind::next_chapter);
  EXPECT_EQ(now_s(), 40.0);
  EXPECT_EQ(command(Kind::next_chapter), CommandOutcome::refused);
  EXPECT_EQ(playback_.refusal(), "this is the last chapter");
  command(Kind::previous_chapter);
  EXPECT_EQ(now_s(), 20.0) << "right at its start, the one before";
  time_.pass(5.0);
  command(Kind::previous_chapter);
  EXPECT_EQ(now_s(), 20.0) << "later on, to its own start";
}

TEST_F(TransportCommands, AChapterThatIsNotThereIsRefused) {
  EXPECT_EQ(command(Kind::chapter, 3.0), CommandOutcome::refused);
  EXPECT_EQ(playback_.refusal(), "the show has chapters 0 to 2");
  EXPECT_EQ(command(Kind::chapter, -1.0), CommandOutcome::refused);
}

TEST_F(TransportCommands, ARefusalIsInTheLanguageThatWasChosen) {
  command(Kind::language, 0.0, "de");
  command(Kind::chapter, 3.0);
  EXPECT_EQ(playback_.refusal(), "die Vorführung hat die Kapitel 0 bis 2");
}

TEST_F(TransportCommands, BlackoutFadesAndComesBack) {
  command(Kind::blackout, 1.0);
  EXPECT_EQ(playback_.light(), 1.0);
  time_.pass(0.5);
  playback_.advance();
  EXPECT_DOUBLE_EQ(playback_.light(), 0.5);
  EXPECT_TRUE(status().blackout);
  command(Kind::toggle_blackout);
  EXPECT_DOUBLE_EQ(playback_.light(), 0.5);
  time_.pass(0.5);
  playback_.advance();
  EXPECT_DOUBLE_EQ(playback_.light(), 1.0);
}

TEST_F(TransportCommands, ABlackoutOfAnEarlierShowGoesOnWithoutALightMoment) {
  playback_.darken();
  EXPECT_EQ(playback_.light(), 0.0);
  time_.pass(5.0);
  playback_.advance();
  EXPECT_EQ(playback_.light(), 0.0);
  EXPECT_TRUE(status().blackout);
  command(Kind::blackout, 0.0);
  time_.pass(0.5);
  playback_.advance();
  EXPECT_DOUBLE_EQ(playback_.light(), 0.5);
}

TEST_F(TransportCommands, LanguagesGoRound) {
  EXPECT_THAT(status().languages, testing::ElementsAre("de", "en", "fr"));
  EXPECT_EQ(playback_.language(), "en");
  command(Kind::next_language);
  EXPECT_EQ(playback_.language(), "fr");
  command(Kind::next_language);
  EXPECT_EQ(status().chapters[0].title, "Draußen");
  EXPECT_EQ(command(Kind::language, 0.0, "tlh"), CommandOutcome::refused);
  EXPECT_EQ(playback_.refusal(), "verfügbare Sprachen: de, en, fr");
  EXPECT_EQ(playback_.language(), "de");
}

TEST_F(TransportCommands, WhatIsSetIsInTheStatus) {
  command(Kind::exposure, 1.5);
  command(Kind::volume, 7.0);
  command(Kind::captions, 0.0);
  command(Kind::loop, 0.0);
  EXPECT_EQ(status().baseline, 0.1) << "the show's";
  command(Kind::baseline, 0.3);
  const PlayerStatus all = status();
  EXPECT_EQ(all.exposure_stops, 1.5);
  EXPECT_EQ(all.volume, 1.0);
  EXPECT_FALSE(all.captions);
  EXPECT_FALSE(all.loop);
  EXPECT_EQ(all.baseline, 0.3);
  EXPECT_EQ(all.duration_s, 60.0);
  EXPECT_EQ(all.title, "Once around");
  EXPECT_EQ(all.clock, "own");
}

TEST(PlaybackTitle, IsInTheLanguageThatIsChosen) {
  Show show;
  show.title = {{"en", "Night"}, {"de", "Nacht"}};
  Playback playback(show, {.language = "de-AT"});
  PlayerStatus status;
  playback.fill(status);
  EXPECT_EQ(status.title, "Nacht");
  EXPECT_THAT(status.languages, testing::ElementsAre("de", "en"));
  playback.apply({Kind::next_language, 0.0, {}});
  playback.fill(status);
  EXPECT_EQ(status.title, "Night");
}

TEST_F(TransportCommands, ResetTakesBackWhatWasSetAndIsForOthersToo) {
  command(Kind::exposure, 1.5);
  command(Kind::baseline, 0.3);
  EXPECT_EQ(command(Kind::reset), CommandOutcome::elsewhere);
  EXPECT_EQ(playback_.exposure_stops(), 0.0);
  EXPECT_FALSE(playback_.baseline());
}

TEST_F(TransportCommands, WhatIsForOthersIsLeftToThem) {
  EXPECT_EQ(command(Kind::free_flight), CommandOutcome::elsewhere);
  EXPECT_EQ(command(Kind::return_to_path), CommandOutcome::elsewhere);
  EXPECT_EQ(command(Kind::reload), CommandOutcome::elsewhere);
}

TEST_F(TransportCommands, WhatIsNoNumberChangesNothing) {
  command(Kind::seek, 30.0);
  for (const Kind kind : {Kind::seek, Kind::seek_by, Kind::step, Kind::speed, Kind::chapter, Kind::exposure}) {
    EXPECT_EQ(command(kind, std::nan("")), CommandOutcome::refused);
    EXPECT_EQ(command(kind, HUGE_VAL), CommandOutcome::refused);
  }
  EXPECT_EQ(now_s(), 30.0);
}

TEST_F(TransportCommands, NumbersWithoutMeasureStayWithinTheShow) {
  for (const Kind kind : {Kind::seek, Kind::seek_by, Kind::step, Kind::speed, Kind::chapter, Kind::exposure}) {
    command(kind, 1e300);
    command(kind, -1e300);
  }
  EXPECT_GE(now_s(), 0.0);
  EXPECT_LE(now_s(), 60.0);
}

TEST_F(TransportCommands, AClockFromOutsideMovesTheShowAlone) {
  const auto clock = std::make_shared<ExternalClock>("MIDI time code", 1s);
  playback_.follow(clock);
  EXPECT_EQ(status().clock, "MIDI time code, not heard yet");
  EXPECT_EQ(status().clock_state, "waiting");
  EXPECT_FALSE(status().clock_silence_s);
  clock->post({40s, 1.0, time_.now, time_.now});
  EXPECT_EQ(now_s(), 40.0);
  EXPECT_EQ(status().clock, "MIDI time code");
  EXPECT_EQ(status().follows, "MIDI time code");
  EXPECT_EQ(status().clock_state, "following");
  EXPECT_EQ(status().clock_silence_s, 0.0);
  EXPECT_EQ(command(Kind::seek, 3.0), CommandOutcome::refused);
  EXPECT_EQ(playback_.refusal(), "the show follows MIDI time code");
  EXPECT_EQ(command(Kind::exposure, 1.0), CommandOutcome::done);
  time_.pass(0.6);
  EXPECT_EQ(status().clock, "MIDI time code, lost, runs on");
  EXPECT_EQ(status().clock_state, "running_on");
  time_.pass(5.0);
  EXPECT_EQ(status().clock, "MIDI time code, lost, stopped");
  EXPECT_EQ(status().clock_state, "stopped");
  EXPECT_NEAR(status().clock_silence_s.value_or(0.0), 5.6, 1e-9);
  playback_.follow(nullptr);
  EXPECT_EQ(status().clock_state, "own");
  EXPECT_FALSE(status().clock_silence_s);
  EXPECT_EQ(status().follows, "");
  EXPECT_EQ(command(Kind::seek, 3.0), CommandOutcome::done);
}

TEST_F(TransportCommands, AnotherVersionOfTheShowKeepsWhatWasSet) {
  time_.pass(10.0);
  command(Kind::language, 0.0, "de");
  command(Kind::exposure, 2.0);
  Show next = show_with_chapters();
  next.duration_s = 90.0;
  next.timeline.chapters.clear();
  next.timeline.captions.resize(1);
  next.timeline.captions[0].text = {{"de", "Hallo"}, {"en", "Hello"}};
  playback_.set_show(next);
  EXPECT_EQ(now_s(), 10.0);
  EXPECT_EQ(playback_.language(), "de");
  EXPECT_EQ(playback_.exposure_stops(), 2.0);
  EXPECT_EQ(playback_.chapter(), -1);
  EXPECT_EQ(status().duration_s, 90.0);
}

TEST(PlaybackLanguage, APersonsChoiceComesFirstAndItsWiderLanguageNext) {
  FakeTime time;
  EXPECT_EQ(Playback(show_with_chapters(), {"fr", 1s, time.source()}).language(), "fr");
  EXPECT_EQ(Playback(show_with_chapters(), {"de-CH", 1s, time.source()}).language(), "de");
  EXPECT_EQ(Playback(show_with_chapters(), {"pl", 1s, time.source()}).language(), "en");
}

TEST(PlaybackLanguage, IsToldWhereTheShowDoesNotSpeakIt) {
  const Timeline heard = show_with_chapters().timeline;
  EXPECT_THAT(language_note("tour", heard, "pl"),
              testing::StartsWith("tour has no captions or sound in \"pl\"; available: "));
  EXPECT_THAT(language_note("tour", heard, "pl"), testing::EndsWith("; using en"));
  for (const char* known : {"", "fr", "de-CH"}) {
    EXPECT_EQ(language_note("tour", heard, known), "") << known;
  }
  EXPECT_EQ(language_note("tour", {}, "pl"), "") << "a show without words speaks to all";
}

}  // namespace
}  // namespace ergodome
