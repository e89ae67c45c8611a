#include "app/playback/sound/audio_player.h"

#include <exception>
#include <utility>

#include "app/playback/sound/audio_file.h"
#include "app/playback/sound/audio_output.h"

namespace ergodome {

namespace {

const std::string no_device = "no sound device was found; the show continues without sound";

constexpr auto pace = std::chrono::milliseconds(20);
constexpr auto check_interval = std::chrono::seconds(5);
//! If the player sends no cue for this long, it hangs, and the sound stops.
constexpr auto max_silence = std::chrono::seconds(10);

}  // namespace

AudioPlayer::AudioPlayer(double later_s) : later_s_(later_s) {
  // Sets environment variables, which is safer before another thread exists.
  silence_sound_libraries();
  thread_ = std::thread([this] { run(); });
}

AudioPlayer::~AudioPlayer() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void AudioPlayer::set_soundtrack(Soundtrack soundtrack) {
  const std::lock_guard lock(mutex_);
  new_soundtrack_ = std::move(soundtrack);
}

void AudioPlayer::follow(const AudioCue& cue) {
  bool jumped = false;
  {
    const std::lock_guard lock(mutex_);
    jumped = !cue_ || cue_->instant.jumps != cue.instant.jumps || cue_->instant.playing != cue.instant.playing;
    cue_ = cue;
  }
  if (jumped) {
    wake_.notify_one();
  }
}

std::vector<std::string> AudioPlayer::take_problems() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problems_, {});
}

std::string AudioPlayer::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

std::string AudioPlayer::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void AudioPlayer::say(std::string problem) {
  // The number of messages is limited, because they may never be read.
  constexpr std::size_t maximum = 100;
  const std::lock_guard lock(mutex_);
  problem_ = problem;
  if (problems_.size() < maximum) {
    problems_.push_back(std::move(problem));
  }
}

void AudioPlayer::unsay(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  if (problem_ == problem) {
    problem_.clear();
  }
}

void AudioPlayer::set_state(std::string state) {
  const std::lock_guard lock(mutex_);
  state_ = std::move(state);
}

void AudioPlayer::find_output() {
  if (output_ && !output_->connected()) {
    mixer_.reset();
    output_.reset();
  }
  const MonotonicTime now = steady_time();
  if (output_ || soundtrack_.tracks.empty() || (checked_ && now - *checked_ < check_interval)) {
    return;
  }
  checked_ = now;
  output_ = AudioOutput::open_device();
  // The audio library's null device: it consumes sound at the right pace, but is silent.
  const bool stand_in = output_ && output_->name() == "No Output";
  if (!output_ || stand_in) {
    set_state("no sound device");
    check_files();
    if (!std::exchange(reported_silent_, true)) {
      say(no_device);
    } else {
      // The problem was already logged, but must also be in the status of this show.
      const std::lock_guard lock(mutex_);
      problem_ = no_device;
    }
    output_.reset();
    return;
  }
  reported_silent_ = false;
  unsay(no_device);
  set_state(output_->name());
}

void AudioPlayer::take_over(Soundtrack soundtrack) {
  mixer_.reset();
  soundtrack_ = std::move(soundtrack);
  checked_.reset();
  checked_files_ = false;
}

void AudioPlayer::check_files() {
  if (std::exchange(checked_files_, true)) {
    return;
  }
  for (const AudioTrack& track : soundtrack_.tracks) {
    const std::string problem = sound_problem(soundtrack_.folder / track.file);
    if (!problem.empty() && reported_files_.insert(problem).second) {
      say(problem);
    }
  }
}

void AudioPlayer::mix(const AudioCue& cue) {
  if (!output_) {
    return;
  }
  if (!mixer_) {
    mixer_ = std::make_unique<AudioMixer>(*output_, soundtrack_, steady_time, later_s_);
  }
  AudioCue heard = cue;
  if (steady_time() - cue.instant.now > max_silence) {
    heard.instant.playing = false;
  }
  mixer_->update(heard);
  for (std::string& problem : mixer_->take_problems()) {
    say(std::move(problem));
  }
}

void AudioPlayer::run() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    if (auto soundtrack = std::exchange(new_soundtrack_, std::nullopt)) {
      problem_.clear();
      take_over(std::move(*soundtrack));
    }
    const std::optional<AudioCue> cue = cue_;
    lock.unlock();
    try {
      find_output();
      if (cue) {
        mix(*cue);
      }
    } catch (const std::exception& problem) {
      // A show continues without sound.
      say(problem.what());
      soundtrack_.tracks.clear();
      mixer_.reset();
    }
    lock.lock();
    if (!ends_) {
      wake_.wait_for(lock, pace);
    }
  }
  lock.unlock();
  mixer_.reset();
  output_.reset();
}

}  // namespace ergodome
