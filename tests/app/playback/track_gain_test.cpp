#include <gtest/gtest.h>

#include "app/playback/sound/audio_mixer.h"

namespace ergodome {
namespace {

//! Returns a track that starts ten seconds into its show.
AudioTrack track_from_ten_seconds() {
  AudioTrack track;
  track.from_s = 10.0;
  return track;
}

TEST(TrackGain, FadesInAndOut) {
  AudioTrack track = track_from_ten_seconds();
  track.fade_in_s = 2.0;
  track.fade_out_s = 4.0;
  EXPECT_EQ(track_gain(track, 20.0, 0.0, 9.99), 0.0);
  EXPECT_DOUBLE_EQ(track_gain(track, 20.0, 0.0, 11.0), 0.5);
  EXPECT_EQ(track_gain(track, 20.0, 0.0, 20.0), 1.0);
  EXPECT_DOUBLE_EQ(track_gain(track, 20.0, 0.0, 29.0), 0.25);
  EXPECT_EQ(track_gain(track, 20.0, 0.0, 30.0), 0.0);
}

TEST(TrackGain, FadesOutBeforeTheShowEnds) {
  AudioTrack track = track_from_ten_seconds();
  track.fade_out_s = 4.0;
  EXPECT_DOUBLE_EQ(track_gain(track, 100.0, 60.0, 59.0), 0.25) << "a file longer than the show";
  track.loop = true;
  EXPECT_DOUBLE_EQ(track_gain(track, 1.0, 60.0, 58.0), 0.5) << "one that repeats until then";
  EXPECT_EQ(track_gain(track, 1.0, 0.0, 1e9), 1.0) << "a show that does not end";
}

}  // namespace
}  // namespace ergodome
