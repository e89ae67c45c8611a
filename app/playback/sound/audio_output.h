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
  //! Two channels in memory that `render` fills, as fast as it is asked.
  static std::unique_ptr<AudioOutput> open_memory(int rate_hz);

  ~AudioOutput();
  AudioOutput(const AudioOutput&) = delete;
  AudioOutput& operator=(const AudioOutput&) = delete;

  //! Makes this output current for OpenAL calls of this thread.
  void make_current() const;
  //! Returns the name given by the audio library.
  [[nodiscard]] const std::string& name() const { return name_; }
  //! False once a device has been unplugged.
  [[nodiscard]] bool connected() const;
  //! How long it takes until what is mixed now is heard [s], as far as the device tells.
  [[nodiscard]] double latency_s() const;
  //! The next frames of an output in memory, left and right side by side.
  [[nodiscard]] std::vector<float> render(int frames) const;

 private:
  //! The library's handles, whose types are not called alike in all its versions.
  struct Handles;
  explicit AudioOutput(std::unique_ptr<Handles> handles);
  static std::unique_ptr<AudioOutput> open(void* device, const int* attributes);

  std::unique_ptr<Handles> handles_;
  std::string name_;
};

}  // namespace ergodome
