#define AL_ALEXT_PROTOTYPES
#include "app/playback/sound/audio_output.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <alsa/asoundlib.h>

#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "kernels/core/error.h"

namespace ergodome {

struct AudioOutput::Handles {
  ALCdevice* device;
  ALCcontext* context;
};

AudioOutput::AudioOutput(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {
  const ALCchar* name = alcGetString(handles_->device, ALC_ALL_DEVICES_SPECIFIER);
  name_ = name == nullptr ? "" : name;
}

AudioOutput::~AudioOutput() {
  if (alcGetThreadContext() == handles_->context) {
    alcSetThreadContext(nullptr);
  }
  alcDestroyContext(handles_->context);
  alcCloseDevice(handles_->device);
}

std::unique_ptr<AudioOutput> AudioOutput::open(void* device, const int* attributes) {
  auto* const opened = static_cast<ALCdevice*>(device);
  if (opened == nullptr) {
    return nullptr;
  }
  ALCcontext* const context = alcCreateContext(opened, attributes);
  if (context == nullptr) {
    alcCloseDevice(opened);
    return nullptr;
  }
  return std::unique_ptr<AudioOutput>(new AudioOutput(std::make_unique<Handles>(Handles{opened, context})));
}

std::unique_ptr<AudioOutput> AudioOutput::open_device() {
  // Disables HRTF: stereo for a room must not be processed for headphones.
  const int attributes[] = {ALC_HRTF_SOFT, ALC_FALSE, 0};
  return open(alcOpenDevice(nullptr), attributes);
}

std::unique_ptr<AudioOutput> AudioOutput::open_memory(int rate_hz) {
  const int attributes[] = {ALC_FORMAT_CHANNELS_SOFT,
                            ALC_STEREO_SOFT,
                            ALC_FORMAT_TYPE_SOFT,
                            ALC_FLOAT_SOFT,
                            ALC_FREQUENCY,
                            rate_hz,
                            ALC_HRTF_SOFT,
                            ALC_FALSE,
                            0};
  auto output = open(alcLoopbackOpenDeviceSOFT(nullptr), attributes);
  if (!output) {
    throw Error("sound", "the audio library does not support mixing to memory", "use OpenAL Soft");
  }
  return output;
}

void AudioOutput::make_current() const { alcSetThreadContext(handles_->context); }

bool AudioOutput::connected() const {
  ALCint connected = ALC_TRUE;
  alcGetIntegerv(handles_->device, ALC_CONNECTED, 1, &connected);
  return connected != ALC_FALSE;
}

double AudioOutput::latency_s() const {
  ALCint64SOFT latency_ns = 0;
  alcGetInteger64vSOFT(handles_->device, ALC_DEVICE_LATENCY_SOFT, 1, &latency_ns);
  return static_cast<double>(latency_ns) / 1e9;
}

std::vector<float> AudioOutput::render(int frames) const {
  std::vector<float> samples(2 * static_cast<std::size_t>(frames));
  alcRenderSamplesSOFT(handles_->device, samples.data(), frames);
  return samples;
}

namespace {

void ignore_message(const char* /*file*/, int /*line*/, const char* /*function*/, int /*number*/,
                    const char* /*format*/, ...) {}

}  // namespace

void silence_sound_libraries() {
  static std::once_flag once;
  std::call_once(once, [] {
    snd_lib_error_set_handler(ignore_message);
    // OpenAL Soft reads this variable on first use. A user's value is kept.
    ::setenv("ALSOFT_LOGLEVEL", "0", 0);
  });
}

}  // namespace ergodome
