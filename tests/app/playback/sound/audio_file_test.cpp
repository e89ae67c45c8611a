#include "app/playback/sound/audio_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "tests/app/playback/sound_files.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::error_of;

using AudioFiles = test::FolderTest;

//! Returns silence except for a 1 kHz burst from 2.0 to 2.1 s.
double burst(double time_s, int /*channel*/) {
  return time_s >= 2.0 && time_s < 2.1 ? 0.5 * std::sin(2000.0 * std::numbers::pi * time_s) : 0.0;
}

//! Returns the time [s] of the first loud sample, in a file that is read from one second on.
double heard_burst_s(const std::filesystem::path& path) {
  AudioFile file(path);
  std::vector<float> samples(static_cast<std::size_t>(file.channels()) * static_cast<std::size_t>(file.rate_hz()) * 2);
  EXPECT_TRUE(file.read(file.rate_hz(), false, samples));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::abs(samples[i]) > 0.1F) {
      const std::size_t frame = i / static_cast<std::size_t>(file.channels());
      return 1.0 + static_cast<double>(frame) / file.rate_hz();
    }
  }
  return 0.0;
}

TEST_F(AudioFiles, OfEveryKindAreReadFromTheMiddle) {
  struct Kind {
    const char* name;
    int format;
    double tolerance_s;
  };
  // The third number is the tolerance [s]: lossy formats smear the start of a burst.
  for (const Kind& kind :
       {Kind{"a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 0.0005},
        Kind{"a.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 0.0005},
        Kind{"a.ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 0.005}, Kind{"a.opus", SF_FORMAT_OGG | SF_FORMAT_OPUS, 0.005},
        Kind{"a.mp3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III, 0.005}}) {
    test::write_sound(folder_ / kind.name, {kind.format, 48000, 2, 3.0}, burst);
    EXPECT_NEAR(heard_burst_s(folder_ / kind.name), 2.0, kind.tolerance_s) << kind.name;
  }
}

TEST_F(AudioFiles, AreSilentBeforeTheirStartAndBeyondTheirEnd) {
  test::write_sound(folder_ / "a.wav", {SF_FORMAT_WAV | SF_FORMAT_FLOAT, 8000, 1, 0.001},
                    [](double, int) { return 0.25; });
  AudioFile file(folder_ / "a.wav");
  ASSERT_EQ(file.frames(), 8);
  std::vector<float> samples(12, 9.0F);
  EXPECT_TRUE(file.read(-2, false, samples));
  EXPECT_THAT(samples, testing::ElementsAre(0, 0, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0, 0));
  EXPECT_TRUE(file.read(-100, false, samples));
  EXPECT_THAT(samples, testing::Each(0.0F));
  EXPECT_TRUE(file.read(1'000'000'000'000, false, samples));
  EXPECT_THAT(samples, testing::Each(0.0F));
}

TEST_F(AudioFiles, RepeatWithoutASeam) {
  test::write_sound(folder_ / "a.wav", {SF_FORMAT_WAV | SF_FORMAT_FLOAT, 8000, 1, 0.0005},
                    [](double time_s, int) { return time_s * 1000.0; });
  AudioFile file(folder_ / "a.wav");
  std::vector<float> samples(6);
  EXPECT_TRUE(file.read(4'000'000'000'002, true, samples));
  EXPECT_THAT(samples, testing::ElementsAre(0.25F, 0.375F, 0.0F, 0.125F, 0.25F, 0.375F));
}

TEST_F(AudioFiles, WhatIsNoSampleIsSilence) {
  test::write_sound(folder_ / "a.wav", {SF_FORMAT_WAV | SF_FORMAT_FLOAT, 8000, 1, 0.0005}, [](double time_s, int) {
    return time_s == 0.0 ? std::nan("") : time_s < 0.0002 ? std::numeric_limits<double>::infinity() : 1e30;
  });
  AudioFile file(folder_ / "a.wav");
  std::vector<float> samples(4);
  EXPECT_TRUE(file.read(0, false, samples));
  EXPECT_THAT(samples, testing::ElementsAre(0.0F, 0.0F, 4.0F, 4.0F));
}

TEST_F(AudioFiles, ThatShrinkWhileTheyPlayAreStillLimited) {
  test::write_sound(folder_ / "a.wav", {SF_FORMAT_WAV | SF_FORMAT_FLOAT, 48000, 1, 3.0},
                    [](double, int) { return 1e30; });
  AudioFile file(folder_ / "a.wav");
  std::filesystem::resize_file(folder_ / "a.wav", std::filesystem::file_size(folder_ / "a.wav") / 2);
  std::vector<float> samples(3 * 48000);
  EXPECT_FALSE(file.read(0, false, samples));
  EXPECT_EQ(samples.front(), 4.0F);
  EXPECT_LE(std::ranges::max(samples), 4.0F);
}

TEST_F(AudioFiles, ThatAreCutOffSayEitherSoAtOnceOrWhenTheyEnd) {
  test::write_sound(folder_ / "a.flac", {SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 48000, 2, 3.0}, burst);
  std::filesystem::resize_file(folder_ / "a.flac", std::filesystem::file_size(folder_ / "a.flac") / 3);
  AudioFile file(folder_ / "a.flac");
  std::vector<float> samples(2 * 48000 * 3);
  EXPECT_FALSE(file.read(0, false, samples));
}

TEST_F(AudioFiles, OfEveryKindThatAreTornHaveAProblemAndWholeOnesNone) {
  for (const auto& [name, format] :
       {std::pair{"a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_24}, std::pair{"a.aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16},
        std::pair{"large.wav", SF_FORMAT_RF64 | SF_FORMAT_PCM_16}, std::pair{"a.w64", SF_FORMAT_W64 | SF_FORMAT_PCM_16},
        std::pair{"a.au", SF_FORMAT_AU | SF_FORMAT_PCM_16},
        std::pair{"little.au", SF_FORMAT_AU | SF_FORMAT_PCM_16 | SF_ENDIAN_LITTLE},
        std::pair{"a.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16}, std::pair{"a.ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS},
        std::pair{"a.opus", SF_FORMAT_OGG | SF_FORMAT_OPUS},
        std::pair{"a.mp3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III}}) {
    const std::filesystem::path path = folder_ / name;
    test::write_sound(path, {format, 48000, 1, 3.0}, burst);
    EXPECT_EQ(sound_problem(path), "") << name;
    std::filesystem::resize_file(path, std::filesystem::file_size(path) * 2 / 3);
    EXPECT_THAT(sound_problem(path), testing::HasSubstr(name)) << name;
  }
}

TEST_F(AudioFiles, OfALengthThatWasNotKnownWhenTheyWereWrittenAreNotTorn) {
  test::write_sound(folder_ / "a.wav", {SF_FORMAT_WAV | SF_FORMAT_PCM_16, 48000, 1, 0.1}, burst);
  std::fstream file(folder_ / "a.wav", std::ios::in | std::ios::out | std::ios::binary);
  std::string head(44, ' ');
  file.read(head.data(), 44);
  ASSERT_EQ(head.substr(36, 4), "data");
  file.seekp(40);
  file << "\xFF\xFF\xFF\xFF" << std::flush;
  EXPECT_EQ(sound_problem(folder_ / "a.wav"), "");
}

TEST_F(AudioFiles, Mp3WithoutAHeaderOfItsLengthIsPlayedToItsEnd) {
  // The file contains 30 s of a tone, in MP3 with a variable bit rate but without a Xing header.
  const std::filesystem::path path = ERGODOME_TEST_DATA_DIR "/foreign/sound/vbr.mp3";
  EXPECT_EQ(sound_problem(path), "");
  AudioFile file(path);
  EXPECT_NEAR(file.length_s(), 30.0, 0.1);
  std::vector<float> samples(static_cast<std::size_t>(file.channels()) * 4800);
  for (const double time_s : {29.5, 1.0, 15.0}) {
    EXPECT_TRUE(file.read(static_cast<std::int64_t>(time_s * file.rate_hz()), false, samples));
    EXPECT_GT(std::abs(*std::ranges::max_element(samples)), 0.01F) << time_s;
  }
}

TEST_F(AudioFiles, FlacOfUnknownLengthIsCounted) {
  const std::filesystem::path path = folder_ / "a.flac";
  test::write_sound(path, {SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 48000, 2, 3.0}, burst);
  // Clears the number of samples: the lower 36 bits of an 8-byte field of STREAMINFO (RFC 9639,
  // 8.2). STREAMINFO follows a 4-byte marker and a 4-byte header.
  std::fstream bytes(path, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekg(21);
  const char rate_and_length = static_cast<char>(bytes.get() & 0xF0);
  bytes.seekp(21);
  bytes << rate_and_length << std::string(4, '\0') << std::flush;
  EXPECT_EQ(sound_problem(path), "");
  EXPECT_EQ(AudioFile(path).frames(), 144'000);
  EXPECT_NEAR(heard_burst_s(path), 2.0, 0.0005);
}

TEST_F(AudioFiles, FlacOfUnknownLengthThatExpandsToDaysIsRefused) {
  const std::filesystem::path path = folder_ / "a.flac";
  constexpr int block_frames = 4096;
  constexpr int blocks = 100;
  test::write_sound(path, {SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 48000, 8, blocks * block_frames / 48000.0},
                    [](double, int) { return 0.0; });
  std::ifstream one(path, std::ios::binary);
  std::string stream{std::istreambuf_iterator<char>(one), {}};
  for (std::size_t byte = 21; byte < 26; ++byte) {
    stream[byte] = byte == 21 ? static_cast<char>(stream[byte] & 0xF0) : '\0';
  }
  const std::size_t head = stream.find("\xFF\xF8");
  ASSERT_NE(head, std::string::npos);
  const std::string block = stream.substr(head, (stream.size() - head) / blocks);
  std::string days = stream.substr(0, head);
  for (int written = 0; written < 50'000; ++written) {
    days += block;
  }
  std::ofstream(path, std::ios::binary) << days;
  EXPECT_THAT(sound_problem(path), testing::HasSubstr("too long to measure"));
}

TEST_F(AudioFiles, KindsThatAreNotSupportedAreNamed) {
  using namespace std::string_view_literals;
  const std::pair<std::string_view, const char*> kinds[] = {
      {"\0\0\0\x20"
       "ftypM4A \0\0\0\0"sv,
       "M4A"},
      {"\xFF\xF1\x50\x80\x00\x1F\xFC\x00"sv, "is AAC"},
      {"\x30\x26\xB2\x75\x8E\x66\xCF\x11\xA6\xD9\x00\xAA"sv, "WMA"},
      {"OggS\0\2\0\0\0\0\0\0\0\0\x82\xF4\x0C\x25\0\0\0\0\xA9\x97\xC5\xCC\1\x33\x7F"
       "FLAC\1\0"sv,
       "FLAC in an Ogg container"}};
  for (const auto& [head, name] : kinds) {
    std::ofstream(folder_ / "a.mp3", std::ios::binary) << head << std::string(1000, '\0');
    EXPECT_THAT(sound_problem(folder_ / "a.mp3"), testing::HasSubstr(name));
  }
  // The file contains two Ogg streams, one after the other.
  test::write_sound(folder_ / "a.ogg", {SF_FORMAT_OGG | SF_FORMAT_VORBIS, 48000, 1, 0.5}, burst);
  std::ifstream one(folder_ / "a.ogg", std::ios::binary);
  const std::string stream{std::istreambuf_iterator<char>(one), {}};
  std::ofstream(folder_ / "chain.ogg", std::ios::binary) << stream << stream;
  EXPECT_EQ(sound_problem(folder_ / "a.ogg"), "");
  EXPECT_THAT(sound_problem(folder_ / "chain.ogg"), testing::HasSubstr("chain of Ogg streams"));
}

TEST_F(AudioFiles, ThatAreNoSoundAreErrorsWithARemedy) {
  std::ofstream(folder_ / "text.wav") << "this is not a sound";
  std::ofstream(folder_ / "empty.wav") << "";
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_ / "text.wav"); }),
              testing::HasSubstr("is not a readable sound file"));
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_ / "text.wav"); }),
              testing::HasSubstr("use a WAV, FLAC, Ogg, Opus or MP3"));
  EXPECT_NE(error_of([&] { const AudioFile file(folder_ / "empty.wav"); }), "");
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_ / "none.wav"); }),
              testing::HasSubstr("is not a regular file"));
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_); }), testing::HasSubstr("is not a regular file"));
}

TEST_F(AudioFiles, OfTooManyChannelsOrOfNoLengthAreErrors) {
  const auto silence = [](double, int) { return 0.0; };
  test::write_sound(folder_ / "many.wav", {SF_FORMAT_WAV | SF_FORMAT_PCM_16, 48000, 9, 0.01}, silence);
  test::write_sound(folder_ / "slow.wav", {SF_FORMAT_WAV | SF_FORMAT_PCM_16, 4000, 1, 0.01}, silence);
  test::write_sound(folder_ / "short.wav", {SF_FORMAT_WAV | SF_FORMAT_PCM_16, 48000, 1, 0.0}, silence);
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_ / "many.wav"); }), testing::HasSubstr("has 9 channels"));
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_ / "slow.wav"); }),
              testing::HasSubstr("a sample rate of 4000 Hz"));
  EXPECT_THAT(error_of([&] { const AudioFile file(folder_ / "short.wav"); }),
              testing::HasSubstr("has no known length"));
}

}  // namespace
}  // namespace ergodome
