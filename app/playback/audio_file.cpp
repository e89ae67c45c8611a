#include "app/playback/audio_file.h"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>

#include "app/playback/sound_bytes.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! A floating point file may hold anything.
float tame(float sample) { return std::isfinite(sample) ? std::clamp(sample, -4.0F, 4.0F) : 0.0F; }

}  // namespace

void AudioFile::Close::operator()(void* file) const { sf_close(static_cast<SNDFILE*>(file)); }

std::string sound_problem(const std::filesystem::path& path) {
  try {
    AudioFile file(path);
    std::ifstream bytes(path, std::ios::binary);
    std::error_code gone;
    const std::uint64_t promised = promised_bytes(bytes);
    const bool whole = promised <= std::filesystem::file_size(path, gone) && file.has_end();
    return whole ? ""
                 : Error(path.string(), "is torn: it breaks off before the end that its header tells",
                         "copy or export it again")
                       .what();
  } catch (const Error& problem) {
    return problem.what();
  }
}

AudioFile::AudioFile(const std::filesystem::path& path) {
  constexpr const char* remedy = "give a WAV, FLAC, Ogg, Opus or MP3 file";
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "is not a file that can be read", remedy);
  }
  SF_INFO info{};
  file_.reset(sf_open(path.c_str(), SFM_READ, &info));
  if (!file_) {
    std::string why = sf_strerror(nullptr);
    why.erase(why.find_last_not_of(" .\n") + 1);
    // So its reader of MP3 says of whatever it does not know; the file is there.
    why = why.starts_with("File does not exist") ? "it holds no sound" : why;
    throw Error(path.string(), fmt::format("is no sound file that can be read ({})", why), remedy);
  }
  if (info.channels < 1 || info.channels > most_channels) {
    throw Error(path.string(), fmt::format("has {} channels", info.channels), "mix it down to 8 or fewer");
  }
  if (info.samplerate < 8000 || info.samplerate > 192'000) {
    throw Error(path.string(), fmt::format("has {} samples a second", info.samplerate), "resample it to 48000");
  }
  // A length that is unknown is told as the largest there is.
  constexpr sf_count_t most_frames = sf_count_t{1} << 40;
  if (info.seekable == 0 || info.frames < 1 || info.frames > most_frames) {
    throw Error(path.string(), "has no length, or cannot be read from the middle", remedy);
  }
  channels_ = info.channels;
  rate_hz_ = info.samplerate;
  frames_ = info.frames;
  guessed_length_ = (info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_MPEG;
}

AudioFile::~AudioFile() = default;

std::int64_t AudioFile::read_within(std::int64_t first_frame, std::int64_t count, float* samples) {
  auto* const file = static_cast<SNDFILE*>(file_.get());
  if (next_frame_ != first_frame && sf_seek(file, first_frame, SF_SEEK_SET) != first_frame) {
    next_frame_ = -1;
    return 0;
  }
  const std::int64_t came = std::clamp<std::int64_t>(sf_readf_float(file, samples, count), 0, count);
  next_frame_ = came == count ? first_frame + count : -1;
  return came;
}

bool AudioFile::has_end() {
  if (guessed_length_) {
    return true;
  }
  std::array<float, most_channels> last{};
  return read_within(frames_ - 1, 1, last.data()) == 1;
}

bool AudioFile::read(std::int64_t first_frame, bool loop, std::span<float> samples) {
  std::ranges::fill(samples, 0.0F);
  const std::int64_t count = static_cast<std::int64_t>(samples.size()) / channels_;
  std::int64_t done = std::clamp<std::int64_t>(-first_frame, 0, count);
  while (done < count) {
    const std::int64_t place = first_frame + done;
    if (place >= frames_ && !loop) {
      break;
    }
    const std::int64_t within = place % frames_;
    const std::int64_t part = std::min(count - done, frames_ - within);
    const std::int64_t came = read_within(within, part, samples.data() + done * channels_);
    done += came;
    if (came < part) {
      return false;
    }
  }
  std::ranges::transform(samples, samples.begin(), tame);
  return true;
}

}  // namespace ergodome
