#pragma once

#include <filesystem>
#include <functional>

// Writes sound files for tests.
namespace ergodome::test {

struct SoundFile {
  int format = 0;  //!< format code of libsndfile
  int rate_hz = 48000;
  int channels = 2;
  double length_s = 1.0;
};

//! Writes a sound file; `sample` returns the sample at a time [s] of a channel.
void write_sound(const std::filesystem::path& path, const SoundFile& file,
                 const std::function<double(double, int)>& sample);

//! Writes a floating-point sound file in which each sample encodes its own time: left divided by
//! right is the time as a fraction of the length.
void write_ramp(const std::filesystem::path& path, int rate_hz, double length_s);

}  // namespace ergodome::test
