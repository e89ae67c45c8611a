#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/playback/show_clock.h"
#include "app/playback/sound/audio_output.h"
#include "app/playback/sound/audio_voice.h"
#include "content/timeline/timeline.h"

namespace ergodome {

//! State of the running show that the sound follows.
struct AudioCue {
  ShowInstant instant;
  double volume = 1.0;   //!< factor
  std::string language;  //!< language of the narration
};

//! A show's sound, without its pictures.
struct Soundtrack {
  std::vector<AudioTrack> tracks;
  std::filesystem::path folder;  //!< where their files' relative paths start
  double duration_s = 0.0;       //!< of the show; 0: it does not end
};

//! Returns the volume factor of a track at a time of the show from its gain and fades; 0 if it does not play.
double track_gain(const AudioTrack& track, double length_s, double show_duration_s, double time_s);

//! Plays a show's tracks on an output: all calls on one thread.
//!
//! Between two cues the show is taken to run on as the last one said. Sound follows speeds from a half to twice, its pitch with them;
//! at others, backwards and when the show stands it is silent. What is heard and where the show is are compared all the time: up
//! to 40 ms are made good by playing up to 1 % faster or slower, more by a new beginning.
class AudioMixer {
 public:
  //! `later_s`: by how much sound is to be heard after its picture, for displays that take their time.
  AudioMixer(const AudioOutput& output, Soundtrack soundtrack, TimeSource source = steady_time, double later_s = 0.0);
  ~AudioMixer();

  //! Some 50 times a second. A track that fails is silent from then on.
  void update(const AudioCue& cue);

  //! Returns the problems of tracks since the last call, each once.
  std::vector<std::string> take_problems();
  //! Returns the maximum offset between sound and show over all tracks that play [s].
  [[nodiscard]] double greatest_error_s() const;
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
