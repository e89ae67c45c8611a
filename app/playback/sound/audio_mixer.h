#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/playback/clock/show_clock.h"
#include "app/playback/sound/audio_output.h"
#include "app/playback/sound/audio_voice.h"
#include "content/timeline/timeline.h"

namespace ergodome {

//! State of the running show that the sound follows.
struct AudioCue {
  ShowInstant instant;
  double volume = 1.0;   //!< volume factor
  std::string language;  //!< language of the narration
};

//! A show's sound tracks.
struct Soundtrack {
  std::vector<AudioTrack> tracks;
  std::filesystem::path folder;  //!< base folder of the files' relative paths
  double duration_s = 0.0;       //!< duration of the show; 0: endless
};

//! Returns the volume factor of a track at a time of the show from its gain and fades; 0 if it does
//! not play. `length_s` is the length of its file; a show of duration 0 is endless.
double track_gain(const AudioTrack& track, double length_s, double show_duration_s, double time_s);

//! Plays a show's tracks on an output. All calls are on one thread.
//!
//! Between two cues the show is assumed to continue as in the last one. Sound follows speeds from
//! 0.5 to 2, including its pitch; it is silent at other speeds, backward and when paused. Sound and
//! show are compared continuously: offsets up to 40 ms are corrected by playing up to 1 % faster or
//! slower, larger ones by restarting.
class AudioMixer {
 public:
  //! `later_s` is the delay of the sound after its picture, for slow displays.
  AudioMixer(const AudioOutput& output, Soundtrack soundtrack, TimeSource source = steady_time, double later_s = 0.0);
  ~AudioMixer();

  //! Updates the tracks; call it about 50 times a second. A track that fails stays silent.
  void update(const AudioCue& cue);

  //! Returns the problems of tracks since the last call, each once.
  std::vector<std::string> take_problems();
  //! Returns the maximum offset between sound and show over all tracks that play [s].
  [[nodiscard]] double max_error_s() const;
  [[nodiscard]] long restarts() const;

 private:
  struct Voice;
  void open(const AudioTrack& track);
  void play(Voice& voice, const AudioCue& cue, bool jumped);

  const AudioOutput& output_;
  Soundtrack soundtrack_;
  TimeSource source_;
  double later_s_;
  std::vector<std::unique_ptr<Voice>> voices_;
  std::vector<std::string> problems_;
  long jumps_ = 0;
  std::int64_t pass_ = 0;
};

}  // namespace ergodome
