#include "app/playback/sound/audio_player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "tests/app/playback/sound_files.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using namespace std::chrono_literals;

//! Runs the audio library with its dummy device, which must be selected before the first call.
class SoundWithoutDevice : public test::FolderTest {
 protected:
  void SetUp() override {
    test::FolderTest::SetUp();
    ::setenv("ALSOFT_DRIVERS", "null", 1);
  }

  //! Returns a soundtrack with a single track of one second.
  [[nodiscard]] Soundtrack one_track() const {
    test::write_ramp(folder_ / "a.wav", 8000, 1.0);
    AudioTrack track;
    track.file = "a.wav";
    return {{track}, folder_, 10.0};
  }

  //! Waits until the player reports problems, and returns them.
  static std::vector<std::string> first_problems(AudioPlayer& player) {
    std::vector<std::string> problems;
    for (const auto end = steady_time() + 20s; problems.empty() && steady_time() < end;) {
      std::this_thread::yield();
      problems = player.take_problems();
    }
    return problems;
  }
};

TEST_F(SoundWithoutDevice, IsSaidOnceAndTheShowGoesOn) {
  AudioPlayer player;
  player.set_soundtrack(one_track());
  player.follow({ShowInstant{steady_time(), 0s, 0, 0, 1.0, true, 0}, 1.0, ""});
  EXPECT_THAT(first_problems(player),
              testing::ElementsAre("no sound device was found; the show continues without sound"));
  EXPECT_EQ(player.state(), "no sound device");
}

TEST_F(SoundWithoutDevice, FilesThatCannotBePlayedAreToldAllTheSame) {
  Soundtrack missing = one_track();
  missing.tracks.front().file = "gone.wav";
  AudioPlayer player;
  player.set_soundtrack(missing);
  EXPECT_THAT(first_problems(player).front(), testing::HasSubstr("gone.wav: is missing or is not a regular file"));
}

TEST_F(SoundWithoutDevice, IsAProblemUntilAShowWithoutSoundComes) {
  AudioPlayer player;
  player.set_soundtrack(one_track());
  first_problems(player);
  EXPECT_EQ(player.problem(), "no sound device was found; the show continues without sound");
  const auto becomes = [&](const std::string& problem) {
    for (const auto end = steady_time() + 20s; player.problem() != problem && steady_time() < end;) {
      std::this_thread::sleep_for(2ms);
    }
    return player.problem() == problem;
  };
  player.set_soundtrack({{}, folder_, 10.0});
  EXPECT_TRUE(becomes(""));
  player.set_soundtrack(one_track());
  EXPECT_TRUE(becomes("no sound device was found; the show continues without sound")) << "it is the next show's, too";
  EXPECT_TRUE(player.take_problems().empty()) << "and is not said again";
}

TEST_F(SoundWithoutDevice, IsNoneOfTheBusinessOfAShowWithoutSound) {
  AudioPlayer player;
  player.set_soundtrack({{}, folder_, 10.0});
  player.follow({});
  EXPECT_TRUE(player.take_problems().empty());
}

}  // namespace
}  // namespace ergodome
