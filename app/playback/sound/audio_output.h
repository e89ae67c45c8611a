#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ergodome {

//! A sound output: a device of the machine, or memory.
class AudioOutput {
 public:
  //! Opens the default device; returns nullptr if there is none.
  static std::unique_ptr<AudioOutput> open_device();
  //! Opens a stereo output in memory, from which `render` returns the sound. Throws Error if the
  //! audio library does not support that.
  static std::unique_ptr<AudioOutput> open_memory(int rate_hz);

  ~AudioOutput();
  AudioOutput(const AudioOutput&) = delete;
  AudioOutput& operator=(const AudioOutput&) = delete;

  //! Makes this output current for OpenAL calls of this thread.
  void make_current() const;
  //! Returns the name given by the audio library.
  [[nodiscard]] const std::string& name() const { return name_; }
  //! Returns false after the device was unplugged.
  [[nodiscard]] bool connected() const;
  //! Returns the latency of the output [s], as far as the device reports it.
  [[nodiscard]] double latency_s() const;
  //! Returns the next frames of an output in memory, left and right interleaved.
  [[nodiscard]] std::vector<float> render(int frames) const;

 private:
  //! The library's handles, whose type names differ between its versions.
  struct Handles;
  explicit AudioOutput(std::unique_ptr<Handles> handles);
  static std::unique_ptr<AudioOutput> open(void* device, const int* attributes);

  std::unique_ptr<Handles> handles_;
  std::string name_;
};

//! Prevents sound and MIDI libraries from printing messages: Ergodome reports failures itself, and
//! a machine without a device would fill its log. Call it before using any of them; further calls
//! do nothing.
void silence_sound_libraries();

}  // namespace ergodome
