#define AL_ALEXT_PROTOTYPES
#include "app/playback/sound/audio_voice.h"

#include <AL/al.h>
#include <AL/alext.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

//! Mean offsets of the sound above this are corrected by a restart, smaller ones by playing
//! slightly faster or slower.
constexpr double steerable_s = 0.04;
//! Used instead of `steerable_s` after a start, until the sound is measured to be in sync.
constexpr double tolerable_s = 0.01;
//! An offset above this cannot be jitter of the measurement: even a single one causes a restart.
constexpr double lost_s = 0.15;
constexpr double steering_s = 1.0;
constexpr double max_steering = 0.01;
//! Minimum time from a start to a restart, so that a machine that cannot keep up does not restart
//! all the time. A fifth of this time is enough if the sound has not been in sync since the start.
constexpr auto rest = std::chrono::milliseconds(500);
constexpr std::size_t first_buffers = 3;

struct Layout {
  int channels;  //!< number of channels passed to the audio library
  ALenum format;
};

//! Returns the layout for a number of channels. Mono is played on both sides; unsupported numbers
//! of channels are reduced to two.
Layout layout_of(int channels) {
  switch (channels) {
    case 4:
      return {4, AL_FORMAT_QUAD32};
    case 6:
      return {6, AL_FORMAT_51CHN32};
    case 7:
      return {7, AL_FORMAT_61CHN32};
    case 8:
      return {8, AL_FORMAT_71CHN32};
    default:
      return {2, AL_FORMAT_STEREO_FLOAT32};
  }
}

//! Returns the first two of interleaved channels; repeats a single channel.
std::vector<float> to_stereo(const std::vector<float>& samples, int channels) {
  const auto width = static_cast<std::size_t>(channels);
  std::vector<float> stereo;
  stereo.reserve(2 * samples.size() / width);
  for (std::size_t i = 0; i + width <= samples.size(); i += width) {
    stereo.push_back(samples[i]);
    stereo.push_back(samples[i + (width > 1 ? 1 : 0)]);
  }
  return stereo;
}

}  // namespace

AudioVoice::AudioVoice(std::unique_ptr<AudioFile> file, bool loop, TimeSource source)
    : file_(std::move(file)), loop_(loop), source_(std::move(source)), buffer_frames_(file_->rate_hz() / 8) {
  samples_.resize(static_cast<std::size_t>(buffer_frames_) * static_cast<std::size_t>(file_->channels()));
  const Layout layout = layout_of(file_->channels());
  format_ = layout.format;
  alGenSources(1, &voice_);
  alGenBuffers(buffer_count, buffers_.data());
  alSourcei(voice_, AL_SOURCE_RELATIVE, AL_TRUE);
  // Plays left and right directly, without virtual loudspeakers.
  alSourcei(voice_, AL_DIRECT_CHANNELS_SOFT, layout.channels == 2 ? AL_TRUE : AL_FALSE);
}

AudioVoice::~AudioVoice() {
  stop();
  alDeleteSources(1, &voice_);
  alDeleteBuffers(buffer_count, buffers_.data());
}

void AudioVoice::stop() {
  alSourceStop(voice_);
  alSourcei(voice_, AL_BUFFER, 0);
  playing_ = false;
}

double AudioVoice::wished_now_s(const Wish& wish) const {
  return wish.position_s + wish.speed * seconds_of(source_() - wish.at);
}

void AudioVoice::queue(unsigned int buffer) {
  damaged_ = !file_->read(queue_end_, loop_, samples_) || damaged_;
  const bool as_it_is = layout_of(file_->channels()).channels == file_->channels();
  const std::vector<float>& samples = as_it_is ? samples_ : to_stereo(samples_, file_->channels());
  alBufferData(buffer, format_, samples.data(), static_cast<ALsizei>(samples.size() * sizeof(float)), file_->rate_hz());
  alSourceQueueBuffers(voice_, 1, &buffer);
  queue_end_ += buffer_frames_;
}

void AudioVoice::start(const Wish& wish, double latency_s) {
  stop();
  const double ahead_s = (latency_s + lead_s_) * wish.speed;
  queue_start_ = std::llround((wished_now_s(wish) + ahead_s) * file_->rate_hz());
  queue_end_ = queue_start_;
  for (std::size_t i = 0; i < first_buffers; ++i) {
    queue(buffers_[i]);
  }
  alSourcef(voice_, AL_PITCH, static_cast<float>(wish.speed));
  // Skips the part of the beginning that became late while reading.
  const auto late = std::llround((wished_now_s(wish) + ahead_s) * file_->rate_hz()) - queue_start_;
  alSourcei(voice_, AL_SAMPLE_OFFSET,
            static_cast<ALint>(std::clamp<std::int64_t>(late, 0, queue_end_ - queue_start_ - 1)));
  alSourcePlay(voice_);
  for (std::size_t i = first_buffers; i < buffer_count; ++i) {
    queue(buffers_[i]);
  }
  playing_ = true;
  settled_ = false;
  ahead_s_.clear();
  started_ = source_();
}

void AudioVoice::refill() {
  ALint processed = 0;
  alGetSourcei(voice_, AL_BUFFERS_PROCESSED, &processed);
  for (; processed > 0; --processed) {
    ALuint buffer = 0;
    alSourceUnqueueBuffers(voice_, 1, &buffer);
    queue_start_ += buffer_frames_;
    queue(buffer);
  }
}

double AudioVoice::measure(const Wish& wish) const {
  ALdouble offset_and_latency_s[2] = {};
  alGetSourcedvSOFT(voice_, AL_SEC_OFFSET_LATENCY_SOFT, offset_and_latency_s);
  const double queued_s = static_cast<double>(queue_start_) / file_->rate_hz();
  return queued_s + offset_and_latency_s[0] - wish.speed * offset_and_latency_s[1] - wished_now_s(wish);
}

double AudioVoice::keep_in_step(const Wish& wish, double latency_s) {
  const double ahead_s = measure(wish);
  ahead_s_.add(ahead_s);
  constexpr std::size_t enough = 5;
  const double mean_s = ahead_s_.mean();
  const bool off = ahead_s_.count() >= enough && std::abs(mean_s) > (settled_ ? steerable_s : tolerable_s);
  const bool lost = std::abs(ahead_s) > lost_s;
  if ((off || lost) && source_() - started_ >= rest / (settled_ ? 1 : 5)) {
    if (!settled_ && !lost) {
      lead_s_ = std::clamp(lead_s_ - mean_s / wish.speed, -0.2, 0.2);
    }
    ++restarts_;
    start(wish, latency_s);
    return 0.0;
  }
  settled_ = settled_ || ahead_s_.count() >= enough;
  return std::clamp(-mean_s / steering_s, -max_steering, max_steering);
}

bool AudioVoice::play(const Wish& wish, double latency_s) {
  alSourcef(voice_, AL_GAIN, static_cast<float>(wish.gain));
  if (playing_ && !wish.jumped) {
    ALint state = 0;
    refill();
    alGetSourcei(voice_, AL_SOURCE_STATE, &state);
    playing_ = state == AL_PLAYING;
  }
  if (!playing_ || wish.jumped) {
    start(wish, latency_s);
  } else {
    const double steering = keep_in_step(wish, latency_s);
    alSourcef(voice_, AL_PITCH, static_cast<float>(wish.speed * (1.0 + steering)));
  }
  return !damaged_;
}

}  // namespace ergodome
