#include "tests/app/playback/sound_files.h"

#include <sndfile.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace ergodome::test {

void write_sound(const std::filesystem::path& path, const SoundFile& file,
                 const std::function<double(double, int)>& sample) {
  SF_INFO info{};
  info.samplerate = file.rate_hz;
  info.channels = file.channels;
  info.format = file.format;
  SNDFILE* const out = sf_open(path.c_str(), SFM_WRITE, &info);
  if (out == nullptr) {
    throw std::runtime_error(sf_strerror(nullptr));
  }
  const auto frames = std::llround(file.length_s * file.rate_hz);
  std::vector<float> samples;
  samples.reserve(static_cast<std::size_t>(frames * file.channels));
  for (long long i = 0; i < frames; ++i) {
    for (int channel = 0; channel < file.channels; ++channel) {
      samples.push_back(static_cast<float>(sample(static_cast<double>(i) / file.rate_hz, channel)));
    }
  }
  sf_writef_float(out, samples.data(), frames);
  sf_close(out);
}

void write_ramp(const std::filesystem::path& path, int rate_hz, double length_s) {
  write_sound(path, {SF_FORMAT_WAV | SF_FORMAT_FLOAT, rate_hz, 2, length_s},
              [&](double time_s, int channel) { return channel == 0 ? 0.5 * time_s / length_s : 0.5; });
}

}  // namespace ergodome::test
