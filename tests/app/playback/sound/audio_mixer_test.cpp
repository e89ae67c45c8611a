#include "app/playback/sound/audio_mixer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "tests/app/playback/fake_time.h"
#include "tests/app/playback/sound_files.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using namespace std::chrono_literals;
using test::FakeTime;

constexpr double ramp_s = 100.0;
constexpr int device_hz = 48000;
constexpr int chunk = device_hz / 100;

AudioTrack track_of(const std::string& file, double from_s = 0.0) {
  AudioTrack track;
  track.file = file;
  track.from_s = from_s;
  return track;
}

//! Mixes the sound of a show into memory, in chunks of 10 ms.
class SoundOfShow : public test::FolderTest {
 protected:
  //! Writes the test sound once, because it has millions of samples; each test links it into its
  //! folder.
  static void SetUpTestSuite() {
    std::filesystem::create_directories(folder_of_ramp());
    test::write_ramp(folder_of_ramp() / "ramp.wav", 44100, ramp_s);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_of_ramp()); }

  void SetUp() override {
    test::FolderTest::SetUp();
    std::filesystem::create_hard_link(folder_of_ramp() / "ramp.wav", folder_ / "ramp.wav");
  }
  void TearDown() override {
    mixer_.reset();
    output_.reset();
    test::FolderTest::TearDown();
  }

  void play(std::vector<AudioTrack> tracks) {
    mixer_ = std::make_unique<AudioMixer>(*output_, Soundtrack{std::move(tracks), folder_, duration_s}, source());
    clock_.play();
  }

  //! Returns a clock. While `slow_` is set, each reading advances it, to simulate a slow disk.
  TimeSource source() {
    return [this] {
      time_.now += slow_;
      return time_.now;
    };
  }

  //! Mixes the next 10 ms. The audio device runs slower than the clock by the fraction `skew`.
  void mix(double skew = 0.0) {
    ShowInstant instant = clock_.read();
    mixer_->update({instant, volume_, language_});
    slow_ = 0ns;
    mixed_at_ = time_.now;
    samples_ = output_->render(chunk);
    time_.pass(0.01 * (1.0 + skew));
  }

  void mix_for(double seconds, double skew = 0.0) {
    for (int i = 0; i < std::lround(100.0 * seconds); ++i) {
      mix(skew);
    }
  }

  [[nodiscard]] bool silent() const {
    return std::ranges::all_of(samples_, [](float sample) { return sample == 0.0F; });
  }
  [[nodiscard]] double loudness() const { return samples_[2 * (chunk / 2) + 1]; }

  //! heard_s() returns the time in the sound file that is heard in the middle of the last chunk
  //! [s]; error_s() returns its difference from the show time at that moment [s].
  [[nodiscard]] double heard_s() const { return ramp_s * samples_[2 * (chunk / 2)] / samples_[2 * (chunk / 2) + 1]; }
  double error_s() {
    const double since_s = seconds_of(time_.now - mixed_at_) - 0.005;
    return heard_s() - (seconds_of(clock_.read().time) - clock_.speed() * since_s);
  }

  static std::filesystem::path folder_of_ramp() {
    return std::filesystem::temp_directory_path() / ("ergodome-ramp-" + std::to_string(::getpid()));
  }

  static constexpr double duration_s = 120.0;
  FakeTime time_;
  std::chrono::nanoseconds slow_{};
  MonotonicTime mixed_at_{};
  ShowClock clock_{duration_s, 30.0, time_.source()};
  std::unique_ptr<AudioOutput> output_ = AudioOutput::open_memory(device_hz);
  std::unique_ptr<AudioMixer> mixer_;
  std::vector<float> samples_;
  double volume_ = 1.0;
  std::string language_;
};

TEST_F(SoundOfShow, IsWithTheShowFromTheStart) {
  play({track_of("ramp.wav")});
  mix();
  EXPECT_NEAR(error_s(), 0.0, 0.001);
}

TEST_F(SoundOfShow, IsWithinAThousandthOfASecondAfterEverySeek) {
  play({track_of("ramp.wav")});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere_s(1.0, ramp_s - 2.0);
  for (int seek = 0; seek < 50; ++seek) {
    clock_.seek(show_time(anywhere_s(random)));
    for (int i = 0; i < 60; ++i) {
      mix();
      ASSERT_NEAR(error_s(), 0.0, 0.001) << "seek " << seek << ", after " << i << " hundredths of a second";
    }
  }
  EXPECT_EQ(mixer_->restarts(), 0);
}

TEST_F(SoundOfShow, IsInStepAfterASeekOnASlowDisk) {
  play({track_of("ramp.wav")});
  mix_for(1.0);
  clock_.seek(50s);
  slow_ = 15ms;  // per reading of the clock while the file is read
  mix();
  EXPECT_NEAR(error_s(), 0.0, 0.02);
  mix_for(4.0);
  EXPECT_NEAR(error_s(), 0.0, 0.002);
}

TEST_F(SoundOfShow, StaysInStepOnADeviceWhoseClockIsSlow) {
  play({track_of("ramp.wav")});
  double worst_s = 0.0;
  for (int i = 0; i < 6000; ++i) {
    mix(500e-6);
    worst_s = std::max(worst_s, std::abs(error_s()));
  }
  EXPECT_LT(worst_s, 0.002) << "30 ms are lost in this minute";
  EXPECT_EQ(mixer_->restarts(), 0);
}

TEST_F(SoundOfShow, IsBroughtBackAfterTheDeviceStood) {
  play({track_of("ramp.wav")});
  mix_for(2.0);
  time_.pass(1.0);
  mix();
  EXPECT_NEAR(error_s(), 0.0, 0.001);
  EXPECT_EQ(mixer_->restarts(), 1);
}

TEST_F(SoundOfShow, ComesBackInStepGentlyWhereLittleIsMissing) {
  play({track_of("ramp.wav")});
  mix_for(2.0);
  time_.pass(0.02);
  mix_for(0.1);
  EXPECT_GT(std::abs(error_s()), 0.015);
  mix_for(4.0);
  EXPECT_LT(std::abs(error_s()), 0.003);
  EXPECT_EQ(mixer_->restarts(), 0);
}

TEST_F(SoundOfShow, FollowsTheSpeedWithItsPitch) {
  play({track_of("ramp.wav")});
  for (const double speed : {2.0, 0.5, 1.25}) {
    clock_.seek(20s);
    clock_.set_speed(speed);
    mix_for(3.0);
    EXPECT_NEAR(error_s(), 0.0, 0.003) << speed;
  }
}

TEST_F(SoundOfShow, ATurnOfTheSpeedInTheMiddleKeepsItInStep) {
  play({track_of("ramp.wav")});
  mix_for(1.0);
  clock_.set_speed(1.5);
  mix_for(1.0);
  EXPECT_NEAR(error_s(), 0.0, 0.02);
  mix_for(3.0);
  EXPECT_NEAR(error_s(), 0.0, 0.003);
}

TEST_F(SoundOfShow, IsSilentWhenTheShowStandsRunsBackOrVeryFast) {
  play({track_of("ramp.wav")});
  mix_for(1.0);
  EXPECT_FALSE(silent());
  clock_.set_speed(-1.0);
  mix_for(0.1);
  EXPECT_TRUE(silent());
  clock_.set_speed(8.0);
  mix_for(0.1);
  EXPECT_TRUE(silent());
  clock_.set_speed(1.0);
  mix_for(0.1);
  EXPECT_NEAR(error_s(), 0.0, 0.001);
  clock_.pause();
  mix_for(0.1);
  EXPECT_TRUE(silent());
  clock_.play();
  mix_for(0.1);
  EXPECT_NEAR(error_s(), 0.0, 0.001);
}

TEST_F(SoundOfShow, ATrackBeginsAtItsTimeToTheSample) {
  play({track_of("ramp.wav", 1.003)});
  mix_for(1.0);
  EXPECT_TRUE(silent());
  mix();
  const auto first = std::ranges::find_if(samples_, [](float sample) { return std::abs(sample) > 0.1F; });
  // The track starts at 1.003 s, so 3 ms into the chunk that starts at 1 s. The resampler may move
  // the start by a sample or two.
  EXPECT_NEAR(static_cast<double>(first - samples_.begin()) / 2.0, 0.003 * device_hz, 3.0);
}

TEST_F(SoundOfShow, ATrackEndsWithItsFile) {
  test::write_ramp(folder_ / "short.wav", 48000, 0.5);
  play({track_of("short.wav")});
  mix_for(0.4);
  EXPECT_FALSE(silent());
  mix_for(0.2);
  EXPECT_TRUE(silent());
}

TEST_F(SoundOfShow, AFileThatRepeatsIsWhereItsTimeSays) {
  test::write_ramp(folder_ / "short.wav", 48000, 0.7);
  AudioTrack track = track_of("short.wav");
  track.loop = true;
  play({track});
  clock_.seek(70350ms);  // a hundred and a half repetitions
  mix();
  EXPECT_NEAR(0.7 * heard_s() / ramp_s, 0.355, 0.001);
  mix_for(0.7);
  EXPECT_NEAR(0.7 * heard_s() / ramp_s, 0.355, 0.001);
}

TEST_F(SoundOfShow, BeginsAnewWithAShowThatLoops) {
  play({track_of("ramp.wav")});
  clock_.seek(119900ms);
  mix_for(0.3);
  EXPECT_NEAR(error_s(), 0.0, 0.001);
}

TEST_F(SoundOfShow, NarrationIsHeardInItsLanguage) {
  AudioTrack german = track_of("ramp.wav");
  german.language = "de";
  play({german});
  language_ = "en";
  mix_for(0.1);
  EXPECT_TRUE(silent());
  language_ = "de";
  mix_for(0.1);
  EXPECT_NEAR(error_s(), 0.0, 0.001);
}

TEST_F(SoundOfShow, VolumeAndGainAreFactors) {
  AudioTrack track = track_of("ramp.wav");
  play({track});
  mix_for(0.2);
  const double plain = loudness();
  EXPECT_NEAR(plain, 0.5, 0.01) << "as the file has it";
  volume_ = 0.5;
  mix_for(0.2);
  EXPECT_NEAR(loudness() / plain, 0.5, 0.01);
  track.gain_db = -20.0;
  play({track});
  volume_ = 1.0;
  mix_for(0.2);
  EXPECT_NEAR(loudness() / plain, 0.1, 0.002);
}

TEST_F(SoundOfShow, OneChannelIsHeardFromBothSides) {
  test::write_sound(folder_ / "mono.wav", {SF_FORMAT_WAV | SF_FORMAT_PCM_16, 48000, 1, 1.0},
                    [](double, int) { return 0.25; });
  play({track_of("mono.wav")});
  mix_for(0.2);
  EXPECT_NEAR(samples_[400], 0.25, 0.01);
  EXPECT_NEAR(samples_[401], 0.25, 0.01);
}

TEST_F(SoundOfShow, SixChannelsAreMixedDown) {
  test::write_sound(folder_ / "six.wav", {SF_FORMAT_WAV | SF_FORMAT_PCM_16, 48000, 6, 1.0},
                    [](double, int channel) { return channel == 4 ? 0.25 : 0.0; });  // only the left surround channel
  play({track_of("six.wav")});
  mix_for(0.2);
  EXPECT_GT(samples_[400], 0.05);
  EXPECT_GT(samples_[400], samples_[401] + 0.05F);
}

TEST_F(SoundOfShow, GoesOnWithoutTracksThatAreMissingOrBroken) {
  std::ofstream(folder_ / "broken.wav") << "RIFF what follows is no sound";
  play({track_of("none.wav"), track_of("broken.wav"), track_of("ramp.wav")});
  mix_for(0.1);
  EXPECT_NEAR(error_s(), 0.0, 0.001);
  const auto problems = mixer_->take_problems();
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_THAT(problems[0], testing::HasSubstr("none.wav"));
  EXPECT_THAT(problems[1], testing::HasSubstr("broken.wav"));
  EXPECT_TRUE(mixer_->take_problems().empty()) << "each is said once";
}

TEST_F(SoundOfShow, GoesOnWithoutATrackThatEndsTooSoon) {
  test::write_sound(folder_ / "cut.flac", {SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 48000, 2, 20.0},
                    [](double time_s, int) { return 0.3 * std::sin(3000.0 * time_s); });
  std::filesystem::resize_file(folder_ / "cut.flac", std::filesystem::file_size(folder_ / "cut.flac") / 10);
  play({track_of("cut.flac"), track_of("ramp.wav")});
  mix_for(5.0);
  EXPECT_NEAR(error_s(), 0.0, 0.001);
  EXPECT_THAT(mixer_->take_problems(), testing::ElementsAre(testing::HasSubstr("the show continues without it")));
}

}  // namespace
}  // namespace ergodome
