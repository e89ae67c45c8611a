#include "app/playback/sound/audio_mixer.h"

#include <AL/al.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Tracks start this long before they are heard, in silence.
constexpr double run_up_s = 0.25;
constexpr std::size_t max_tracks = 64;

double length_in_show_s(const AudioTrack& track, double length_s, double show_duration_s) {
  const double left_s =
      show_duration_s > 0.0 ? show_duration_s - track.from_s : std::numeric_limits<double>::infinity();
  return track.loop ? left_s : std::min(length_s, left_s);
}

}  // namespace

double track_gain(const AudioTrack& track, double length_s, double show_duration_s, double time_s) {
  const double since_s = time_s - track.from_s;
  const double left_s = length_in_show_s(track, length_s, show_duration_s) - since_s;
  if (!(since_s >= 0.0 && left_s > 0.0)) {
    return 0.0;
  }
  const double in = track.fade_in_s > 0.0 ? std::min(since_s / track.fade_in_s, 1.0) : 1.0;
  const double out = track.fade_out_s > 0.0 ? std::min(left_s / track.fade_out_s, 1.0) : 1.0;
  return in * out * std::pow(10.0, track.gain_db / 20.0);
}

struct AudioMixer::Voice {
  AudioTrack track;
  std::unique_ptr<AudioVoice> sound;  //!< nullptr after a failure
  bool heard = false;
};

AudioMixer::AudioMixer(const AudioOutput& output, Soundtrack soundtrack, TimeSource source, double later_s)
    : output_(output), soundtrack_(std::move(soundtrack)), source_(std::move(source)), later_s_(later_s) {
  output_.make_current();
  if (soundtrack_.tracks.size() > max_tracks) {
    problems_.emplace_back("the show has more than 64 sound tracks; only the first 64 are played");
    soundtrack_.tracks.resize(max_tracks);
  }
  for (const AudioTrack& track : soundtrack_.tracks) {
    open(track);
  }
}

AudioMixer::~AudioMixer() { output_.make_current(); }

void AudioMixer::open(const AudioTrack& track) {
  try {
    auto voice = std::make_unique<Voice>();
    voice->track = track;
    voice->sound =
        std::make_unique<AudioVoice>(std::make_unique<AudioFile>(soundtrack_.folder / track.file), track.loop, source_);
    voices_.push_back(std::move(voice));
  } catch (const Error& problem) {
    problems_.emplace_back(problem.what());
  }
}

void AudioMixer::update(const AudioCue& cue) {
  output_.make_current();
  alListenerf(AL_GAIN, static_cast<float>(std::clamp(cue.volume, 0.0, 1.0)));
  const bool jumped = cue.instant.jumps != jumps_ || cue.instant.pass != pass_;
  jumps_ = cue.instant.jumps;
  pass_ = cue.instant.pass;
  for (const auto& voice : voices_) {
    if (voice->sound) {
      play(*voice, cue, jumped);
    }
  }
}

void AudioMixer::play(Voice& voice, const AudioCue& cue, bool jumped) {
  const AudioTrack& track = voice.track;
  const ShowInstant& instant = cue.instant;
  const double speed = instant.speed;
  const double now_s = seconds_of(instant.time) + speed * seconds_of(source_() - instant.now) - later_s_ * speed;
  const double length_s = voice.sound->file().length_s();
  const bool is_spoken = track.language.empty() || track.language == cue.language;
  const bool follows = instant.playing && speed >= 0.5 && speed <= 2.0;
  const double end_s = track.from_s + length_in_show_s(track, length_s, soundtrack_.duration_s);
  if (!is_spoken || !follows || now_s < track.from_s - run_up_s || now_s >= end_s) {
    if (std::exchange(voice.heard, false)) {
      voice.sound->stop();
    }
    return;
  }
  // During the run-up the file is silent, so its gain is already that of its first sound.
  const double gain = track_gain(track, length_s, soundtrack_.duration_s, std::max(now_s, track.from_s));
  // The position in the file is a difference of integer nanoseconds, so it is exact after any
  // running time.
  const ShowTime position = instant.time - show_time(track.from_s) - show_time(later_s_ * speed);
  voice.heard = true;
  if (!voice.sound->play({seconds_of(position), speed, gain, instant.now, jumped}, output_.latency_s())) {
    problems_.push_back((soundtrack_.folder / track.file).string() +
                        ": is damaged: its length differs from its header; the show continues without it");
    voice.sound.reset();
    voice.heard = false;
  }
}

std::vector<std::string> AudioMixer::take_problems() { return std::exchange(problems_, {}); }

double AudioMixer::max_error_s() const {
  double maximum = 0.0;
  for (const auto& voice : voices_) {
    if (voice->sound && voice->heard) {
      maximum = std::max(maximum, std::abs(voice->sound->lateness_s()));
    }
  }
  return maximum;
}

long AudioMixer::restarts() const {
  long restarts = 0;
  for (const auto& voice : voices_) {
    restarts += voice->sound ? voice->sound->restarts() : 0;
  }
  return restarts;
}

}  // namespace ergodome
