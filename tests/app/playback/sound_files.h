#pragma once

#include <filesystem>
#include <functional>

namespace ergodome::test {

struct SoundFile {
  int format = 0;  //!< of libsndfile
  int rate_hz = 48000;
  int channels = 2;
  double length_s = 1.0;
};

//! Writes a sound file; `sample` gives each by its time [s] and channel.
void write_sound(const std::filesystem::path& path, const SoundFile& file,
                 const std::function<double(double, int)>& sample);

//! A file in floating point that tells where one is in it: left over right is the time over the
//! length.
void write_ramp(const std::filesystem::path& path, int rate_hz, double length_s);

}  // namespace ergodome::test
