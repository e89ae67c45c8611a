#include "app/playback/sound/audio_file.h"

#include <fmt/format.h>
#include <mpg123.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <utility>

#include "app/playback/sound/sound_bytes.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

mpg123_handle* handle_of(void* handle) { return static_cast<mpg123_handle*>(handle); }

//! Clamps a sample to [-4, 4], and replaces NaN and infinity by 0; floating-point files may contain
//! any value.
float tame(float sample) { return std::isfinite(sample) ? std::clamp(sample, -4.0F, 4.0F) : 0.0F; }

std::string first_bytes(const std::filesystem::path& path, std::size_t count) {
  std::string bytes(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

//! Returns whether a file begins with an ID3 tag or with an MPEG audio frame of layer I to III.
bool begins_as_mp3(const std::filesystem::path& path) {
  const std::string head = first_bytes(path, 4);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
  return head.starts_with("ID3") ||
         (head.size() == 4 && byte(0) == 0xFFU && (byte(1) & 0xE0U) == 0xE0U && (byte(1) & 0x06U) != 0);
}

//! Returns whether a file is an Ogg stream of FLAC, some of which libsndfile cannot read (RFC 9639,
//! 10.1).
bool is_ogg_flac(const std::filesystem::path& path) {
  constexpr std::size_t page_head_bytes = 28;
  const std::string head = first_bytes(path, page_head_bytes + 5);
  return head.starts_with("OggS") && head.size() > page_head_bytes &&
         head.substr(page_head_bytes) ==
             "\x7F"
             "FLAC";
}

//! Returns the name of a format that neither library supports; empty for all others.
std::string unsupported_kind(const std::filesystem::path& path) {
  using namespace std::string_view_literals;
  const std::string head = first_bytes(path, 16);
  if (head.size() >= 8 && std::string_view(head).substr(4, 4) == "ftyp") {
    return "MPEG-4 sound (AAC, M4A)";
  }
  if (head.starts_with("ADIF") ||
      (head.size() > 1 && head[0] == '\xFF' && (static_cast<unsigned char>(head[1]) & 0xF6U) == 0xF0U)) {
    return "AAC";
  }
  return head.starts_with("\x30\x26\xB2\x75\x8E\x66\xCF\x11"sv) ? "Windows Media Audio (WMA)" : "";
}

}  // namespace

void Mp3File::Close::operator()(void* handle) const { mpg123_delete(handle_of(handle)); }

std::unique_ptr<Mp3File> Mp3File::open(const std::filesystem::path& path) {
  static const bool ready = mpg123_init() == MPG123_OK;
  std::unique_ptr<Mp3File> file(new Mp3File);
  return ready && file->open_handle(path) ? std::move(file) : nullptr;
}

bool Mp3File::open_handle(const std::filesystem::path& path) {
  handle_.reset(mpg123_new(nullptr, nullptr));
  mpg123_handle* const handle = handle_of(handle_.get());
  if (handle == nullptr) {
    return false;
  }
  mpg123_param(handle, MPG123_ADD_FLAGS, MPG123_QUIET | MPG123_FORCE_FLOAT, 0.0);
  long rate = 0;
  int encoding = 0;
  if (mpg123_open(handle, path.c_str()) != MPG123_OK ||
      mpg123_getformat(handle, &rate, &channels_, &encoding) != MPG123_OK) {
    return false;
  }
  // Decodes the whole file with the sample rate and the number of channels of its first frame.
  mpg123_format_none(handle);
  if (mpg123_format(handle, rate, channels_ == 1 ? MPG123_MONO : MPG123_STEREO, MPG123_ENC_FLOAT_32) != MPG123_OK ||
      mpg123_scan(handle) != MPG123_OK) {
    return false;
  }
  rate_hz_ = static_cast<int>(rate);
  frames_ = mpg123_length(handle);
  return frames_ > 0;
}

std::int64_t Mp3File::read(std::int64_t first_frame, std::int64_t count, float* samples) {
  mpg123_handle* const handle = handle_of(handle_.get());
  if (next_frame_ != first_frame && mpg123_seek(handle, first_frame, SEEK_SET) != first_frame) {
    next_frame_ = -1;
    return 0;
  }
  const std::size_t frame_bytes = sizeof(float) * static_cast<std::size_t>(channels_);
  const std::size_t wanted = frame_bytes * static_cast<std::size_t>(count);
  std::size_t came = 0;
  for (int result = MPG123_OK; came < wanted && (result == MPG123_OK || result == MPG123_NEW_FORMAT);) {
    std::size_t part = 0;
    result = mpg123_read(handle, reinterpret_cast<unsigned char*>(samples) + came, wanted - came, &part);
    came += part;
  }
  const auto frames = static_cast<std::int64_t>(came / frame_bytes);
  next_frame_ = frames == count ? first_frame + count : -1;
  return frames;
}

void AudioFile::Close::operator()(void* file) const { sf_close(static_cast<SNDFILE*>(file)); }

std::string sound_problem(const std::filesystem::path& path) {
  try {
    AudioFile file(path);
    std::ifstream bytes(path, std::ios::binary);
    std::error_code gone;
    const std::uint64_t promised = promised_bytes(bytes);
    const bool whole = promised <= std::filesystem::file_size(path, gone) && file.has_end();
    return whole ? ""
                 : Error(path.string(), "is truncated: it ends before the length given in its header",
                         "copy or export it again")
                       .what();
  } catch (const Error& problem) {
    return problem.what();
  }
}

AudioFile::AudioFile(const std::filesystem::path& path) {
  constexpr const char* remedy = "use a WAV, FLAC, Ogg, Opus or MP3 file";
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "is missing or is not a regular file", remedy);
  }
  if (const std::string kind = unsupported_kind(path); !kind.empty()) {
    throw Error(path.string(), fmt::format("is {}, which is not supported", kind), remedy);
  }
  if (std::ifstream bytes(path, std::ios::binary); is_chained_ogg(bytes)) {
    throw Error(path.string(), "is a chain of Ogg streams, of which only the first would play",
                "join them into one stream");
  }
  SF_INFO info{};
  file_.reset(sf_open(path.c_str(), SFM_READ, &info));
  const bool may_be_mp3 = file_ ? (info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_MPEG : begins_as_mp3(path);
  if (may_be_mp3) {
    mp3_ = Mp3File::open(path);
  }
  if (mp3_) {
    file_.reset();
    info.channels = mp3_->channels();
    info.samplerate = mp3_->rate_hz();
    info.frames = mp3_->frames();
    info.seekable = 1;
  }
  if (!file_ && !mp3_) {
    std::string why = sf_strerror(nullptr);
    why.erase(why.find_last_not_of(" .\n") + 1);
    // libsndfile's MP3 reader reports this for any unknown content, although the file exists.
    why = why.starts_with("File does not exist") ? "it contains no sound" : why;
    if (is_ogg_flac(path)) {
      throw Error(path.string(), "is FLAC in an Ogg container, which cannot be read", "convert it to a .flac file");
    }
    throw Error(path.string(), fmt::format("is not a readable sound file ({})", why), remedy);
  }
  if (info.channels < 1 || info.channels > max_channels) {
    throw Error(path.string(), fmt::format("has {} channels", info.channels), "mix it down to 8 or fewer");
  }
  if (info.samplerate < 8000 || info.samplerate > 192'000) {
    throw Error(path.string(), fmt::format("has a sample rate of {} Hz", info.samplerate), "resample it to 48000 Hz");
  }
  channels_ = info.channels;
  rate_hz_ = info.samplerate;
  frames_ = info.frames;
  // FLAC written to a pipe does not contain its length; the library then reports the largest
  // number.
  constexpr sf_count_t max_frames = sf_count_t{1} << 40;
  if (file_ && frames_ > max_frames && (info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_FLAC) {
    frames_ = counted_frames(path.string());
  }
  if (info.seekable == 0 || frames_ < 1 || frames_ > max_frames) {
    throw Error(path.string(), "has no known length or does not support seeking", remedy);
  }
}

AudioFile::~AudioFile() = default;

std::int64_t AudioFile::counted_frames(const std::string& location) const {
  constexpr sf_count_t frames_at_once = 4096;
  // More than an hour of stereo at 48 kHz, decoded in a few seconds. A short file can expand to
  // years of silence.
  constexpr std::int64_t max_samples = 400'000'000;
  std::vector<float> samples(static_cast<std::size_t>(frames_at_once) * static_cast<std::size_t>(channels_));
  std::int64_t frames = 0;
  for (sf_count_t came = frames_at_once; came == frames_at_once; frames += came) {
    throw_if_reading_stopped(location);
    if (frames > max_samples / channels_) {
      throw Error(location, "does not state its length and is too long to measure by decoding it",
                  "encode it again to a file, not to a pipe");
    }
    came = std::max<sf_count_t>(sf_readf_float(static_cast<SNDFILE*>(file_.get()), samples.data(), frames_at_once), 0);
  }
  return frames;
}

std::int64_t AudioFile::read_within(std::int64_t first_frame, std::int64_t count, float* samples) {
  if (mp3_) {
    return mp3_->read(first_frame, count, samples);
  }
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
  std::array<float, max_channels> last{};
  return read_within(frames_ - 1, 1, last.data()) == 1;
}

bool AudioFile::read(std::int64_t first_frame, bool loop, std::span<float> samples) {
  std::ranges::fill(samples, 0.0F);
  const std::int64_t count = static_cast<std::int64_t>(samples.size()) / channels_;
  std::int64_t done = std::clamp<std::int64_t>(-first_frame, 0, count);
  bool readable = true;
  while (readable && done < count) {
    const std::int64_t position = first_frame + done;
    if (position >= frames_ && !loop) {
      break;
    }
    const std::int64_t within = position % frames_;
    const std::int64_t part = std::min(count - done, frames_ - within);
    const std::int64_t came = read_within(within, part, samples.data() + done * channels_);
    done += came;
    readable = came == part;
  }
  std::ranges::transform(samples, samples.begin(), tame);
  return readable;
}

}  // namespace ergodome
