#include "app/commands/movie/movie.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kernels/core/error.h"
#include "tests/app/cli/command_line.h"

namespace ergodome::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* movie_show = R"(
duration_s = 0.1
frame_rate_hz = 30
[camera]
[[camera.key]]
r = 9
[sky]
map = "sky.ppm"
[view]
size_px = 32
)";

//! Puts a fake ffmpeg first in PATH. It records its arguments and saves its input as the film.
class RenderAMovie : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("small.toml", movie_show);
    old_path_ = std::getenv("PATH");
    ::setenv("PATH", (folder_.string() + ":" + old_path_).c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PATH", old_path_.c_str(), 1);
    CommandLine::TearDown();
  }

  void install(const std::string& body) const {
    write("ffmpeg", "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\n" + body);
    fs::permissions(folder_ / "ffmpeg", fs::perms::owner_all);
  }
  void install_recorder() const {
    install("echo \"$@\" >> '" + (folder_ / "words").string() + "'\nfor last; do :; done\ncat > \"$last\"\n");
  }

  [[nodiscard]] std::string words() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "words").rdbuf();
    return text.str();
  }

  std::string old_path_;
};

TEST_F(RenderAMovie, SendsEveryFramesPixelsAtTheShowsRate) {
  install_recorder();
  ASSERT_EQ(run("render small.toml --out f --movie film.mkv --backend cpu"), 0) << output_;
  EXPECT_EQ(fs::file_size(folder_ / "film.mkv"), 3U * 32 * 32 * 3 * 2);
  EXPECT_THAT(words(), HasSubstr("-s 32x32 -framerate 30 "));
}

TEST_F(RenderAMovie, HasTheRateOfTheCommandLine) {
  install_recorder();
  ASSERT_EQ(run("render small.toml --out f --fps 60 --movie film.mp4 --backend cpu"), 0) << output_;
  EXPECT_EQ(fs::file_size(folder_ / "film.mp4"), 6U * 32 * 32 * 3 * 2);
  EXPECT_THAT(words(), HasSubstr("-framerate 60 "));
}

TEST_F(RenderAMovie, HasTheCoverageOfItsFrames) {
  install_recorder();
  ASSERT_EQ(run("render small.toml --out f --alpha --movie film.mkv --backend cpu"), 0) << output_;
  EXPECT_EQ(fs::file_size(folder_ / "film.mkv"), 3U * 32 * 32 * 4 * 2);
  EXPECT_THAT(words(), HasSubstr("-pix_fmt rgba64"));
  EXPECT_EQ(run("render small.toml --out f --alpha --movie film.mp4 --backend cpu"), 2);
  EXPECT_THAT(output_, HasSubstr("choose .mov or .mkv"));
}

TEST_F(RenderAMovie, SeparateEyesAreTwoFilms) {
  install_recorder();
  ASSERT_EQ(run("render small.toml --out f --stereo separate --movie film.mov --backend cpu"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "film_L.mov"));
  EXPECT_TRUE(fs::exists(folder_ / "film_R.mov"));
}

TEST_F(RenderAMovie, IsNotThereWhenTheEncoderFails) {
  install("cat > /dev/null\necho 'no such codec' >&2\nexit 3\n");
  EXPECT_EQ(run("render small.toml --out f --movie film.mp4 --backend cpu"), 1);
  EXPECT_THAT(output_, HasSubstr("no such codec"));
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4"));
  EXPECT_TRUE(fs::exists(folder_ / "f/small_000003.png"));
}

TEST_F(RenderAMovie, TellsAFullDiskByItsName) {
  install("cat > /dev/null\necho 'write: No space left on device' >&2\necho 'Conversion failed!' >&2\nexit 1\n");
  EXPECT_EQ(run("render small.toml --out f --frames 1:1 --movie film.mp4 --backend cpu"), 1);
  EXPECT_THAT(output_, HasSubstr("film.mp4: cannot be written: No space left on device"));
  EXPECT_THAT(output_, testing::Not(HasSubstr("another ending")));
}

TEST_F(RenderAMovie, IsNoneWhoseLastBytesFoundNoRoomThoughTheEncoderEndsWell) {
  install("for last; do :; done\ncat > \"$last\"\necho 'Error writing trailer: No space left on device' >&2\n");
  EXPECT_EQ(run("render small.toml --out f --frames 1:1 --movie film.mkv --backend cpu"), 1);
  EXPECT_FALSE(fs::exists(folder_ / "film.mkv"));
}

//! Returns the shell script of a fake ffmpeg that reports the given number of frames when it is
//! asked to count those of a film.
std::string encoder_that_finds(const std::string& frames) {
  return "case \"$*\" in *-progress*) printf 'frame=0\\nprogress=continue\\n" + frames +
         "progress=end\\n' >&2; exit 0;; esac\nfor last; do :; done\ncat > \"$last\"\n";
}

TEST_F(RenderAMovie, KeepsItsFramesUnlessItIsToldToDeleteThem) {
  install(encoder_that_finds("frame=3\\n"));
  ASSERT_EQ(run("render small.toml --out f --movie film.mp4 --backend cpu"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "f/small_000003.png"));
  ASSERT_EQ(run("render small.toml --out g/h --movie film.mp4 --backend cpu --delete-frames"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("deleted 3 frame files from g/h\n"));
  EXPECT_FALSE(fs::exists(folder_ / "g"));
  EXPECT_TRUE(fs::exists(folder_ / "film.mp4"));
}

TEST_F(RenderAMovie, DeletesNoFrameThatItDidNotMakeItself) {
  install(encoder_that_finds("frame=3\\n"));
  ASSERT_EQ(run("render small.toml --out f --frames 2 --backend cpu"), 0) << output_;
  write("f/other_000001.png", "of somebody else");
  fs::create_directory(folder_ / "f/L");
  ASSERT_EQ(run("render small.toml --out f --movie film.mp4 --backend cpu --resume --delete-frames"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("deleted 2 frame files from f; kept 1 frame from an earlier run\n"));
  EXPECT_TRUE(fs::exists(folder_ / "f/small_000002.png"));
  EXPECT_FALSE(fs::exists(folder_ / "f/small_000001.png"));
  EXPECT_TRUE(fs::exists(folder_ / "f/other_000001.png"));
  EXPECT_TRUE(fs::exists(folder_ / "f/L"));
  const auto metadata = nlohmann::json::parse(text("f/small.json"));
  EXPECT_EQ(metadata["first_frame"], 2);
  EXPECT_EQ(metadata["last_frame"], 2);
}

TEST_F(RenderAMovie, DeletesBothEyesFramesAndTheirFolders) {
  install(encoder_that_finds("frame=3\\n"));
  ASSERT_EQ(run("render small.toml --out f --stereo separate --movie film.mov --backend cpu --delete-frames"), 0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("deleted 6 frame files from f\n"));
  EXPECT_FALSE(fs::exists(folder_ / "f"));
}

TEST_F(RenderAMovie, KeepsItsFramesWhereTheFilmIsNotWhole) {
  for (const char* const found : {"frame=2\\n", ""}) {
    install(encoder_that_finds(found));
    EXPECT_EQ(run("render small.toml --out f --movie film.mp4 --backend cpu --delete-frames"), 1);
    EXPECT_THAT(output_, HasSubstr("of 3 frames; no frame was deleted"));
    EXPECT_TRUE(fs::exists(folder_ / "f/small_000003.png"));
  }
  install(
      "case \"$*\" in *-progress*) echo frame=3 >&2; echo 'Invalid data' >&2; exit 1;; esac\nfor last; do :; done\ncat "
      "> \"$last\"\n");
  EXPECT_EQ(run("render small.toml --out f --movie film.mp4 --backend cpu --delete-frames"), 1);
  EXPECT_THAT(output_, HasSubstr("cannot be decoded completely (ffmpeg: Invalid data)"));
  EXPECT_TRUE(fs::exists(folder_ / "f/small_000001.png"));
}

TEST_F(RenderAMovie, IsReadBackByTheEncoderItself) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "ffmpeg is not installed";
  }
  for (const char* const film : {"film.mp4", "film.mov", "film.mkv"}) {
    ASSERT_EQ(run(std::string("render small.toml --out f --backend cpu --delete-frames --movie ") + film), 0)
        << output_;
    EXPECT_FALSE(fs::exists(folder_ / "f")) << film;
  }
  Movie movie;
  movie.file = folder_ / "film.mkv";
  movie.pictures.resize(4);
  EXPECT_THAT([&] { check_movie(movie); }, testing::ThrowsMessage<Error>(HasSubstr("has only 3 of 4 frames")));
  fs::resize_file(movie.file, fs::file_size(movie.file) / 2);
  movie.pictures.resize(3);
  EXPECT_THROW(check_movie(movie), Error);
}

//! Returns a sound that is silent for its first tenth of a second and then constant.
std::string sound_with_a_step() {
  constexpr int rate_hz = 48000;
  const std::uint32_t bytes = 2 * rate_hz;
  const auto number = [](std::uint32_t value, int width) {
    std::string text;
    for (int i = 0; i < width; ++i) {
      text += static_cast<char>(value >> (8 * i) & 255U);
    }
    return text;
  };
  std::string wave = "RIFF" + number(36 + bytes, 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) +
                     number(rate_hz, 4) + number(2 * rate_hz, 4) + number(2, 2) + number(16, 2) + "data" +
                     number(bytes, 4);
  for (int i = 0; i < rate_hz; ++i) {
    wave += number(i < rate_hz / 10 ? 0 : 16000, 2);
  }
  return wave;
}

TEST_F(RenderAMovie, IsGivenTelevisionsRatesAsFractions) {
  install_recorder();
  for (const char* rate : {"29.97", "30000/1001", "29.9703"}) {
    fs::remove(folder_ / "words");
    ASSERT_EQ(run(std::string("render small.toml --out f --frames 1:1 --movie film.mkv --backend cpu --fps ") + rate),
              0)
        << output_;
    EXPECT_THAT(words(), HasSubstr("-framerate 30000/1001 ")) << rate;
  }
}

TEST_F(CommandLine, FrameRatesThatAreNoneAreRefused) {
  for (const char* rate : {"30/", "/1001", "1/0", "30:1", "24000/1"}) {
    EXPECT_EQ(run(std::string("render once-around --fps ") + rate), 2) << rate;
    EXPECT_THAT(output_, HasSubstr("nor a fraction like 30000/1001")) << rate;
  }
}

TEST_F(RenderAMovie, HasTheShowsSoundInStepWithItsPictures) {
  write("step.wav", sound_with_a_step());
  write("loud.toml", std::string(movie_show) + "[[audio]]\nfile = \"step.wav\"\nfrom_s = 0\n");
  install("echo \"$@\" > '" + (folder_ / "words").string() + "'\nfor last; do :; done\ncat > \"$last\"\ncat <&3 > '" +
          (folder_ / "sound").string() + "'\n");
  ASSERT_EQ(run("render loud.toml --out f --fps 20 --frames 2:2 --movie film.MP4 --backend cpu"), 0) << output_;
  EXPECT_THAT(words(), HasSubstr("-i pipe:3 -map 0:v -map 1:a -c:a aac"));
  const std::string bytes = text("sound");
  ASSERT_EQ(bytes.size(), 48000U / 20 * 2 * sizeof(float));
}

TEST_F(RenderAMovie, TellsOfSoundThatBreaksOff) {
  write("step.wav", sound_with_a_step().substr(0, 20000));
  write("loud.toml", std::string(movie_show) + "[[audio]]\nfile = \"step.wav\"\nfrom_s = 0\n");
  install("for last; do :; done\ncat > \"$last\"\ncat <&3 > /dev/null\n");
  ASSERT_EQ(run("render loud.toml --out f --frames 1:1 --movie film.MP4 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("step.wav: is truncated: it ends before the length given in its header"));
}

TEST(MovieSound, IsWhereTheShowHasIt) {
  const fs::path folder = fs::temp_directory_path() / ("ergodome-sound-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "step.wav", std::ios::binary) << sound_with_a_step();
  Show show;
  show.folder = folder;
  show.duration_s = 2.0;
  show.timeline.audio.emplace_back();
  show.timeline.audio.back().file = "step.wav";
  show.timeline.audio.back().from_s = 0.25;
  const MovieSound sound(show, "", 0.15, 0.4, folder);
  std::vector<float> samples(2 * 48000);
  const ssize_t bytes = ::read(sound.rewound(), samples.data(), samples.size() * sizeof(float));
  fs::remove_all(folder);
  ASSERT_EQ(bytes, static_cast<ssize_t>(2 * sizeof(float) * 48000 * 4 / 10));
  const auto first = std::ranges::find_if(samples, [](float sample) { return sample > 0.2F; });
  // The step is heard at 0.25 + 0.1 s of the show. The film starts at 0.15 s of the show, so it
  // contains the step at 0.2 s.
  EXPECT_NEAR(static_cast<double>(first - samples.begin()) / 2.0 / 48000.0, 0.2, 0.001);
}

TEST_F(RenderAMovie, TellsWhichEyeLosesItsSharpness) {
  install_recorder();
  ASSERT_EQ(run("render small.toml --out f --frames 1:1 --stereo dubois --movie a.mp4 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("color at half resolution"));
}

TEST(MovieArguments, TagColoursInEveryKindOfFilm) {
  for (const char* file : {"a.mp4", "a.mov", "a.mkv"}) {
    Movie movie;
    movie.file = file;
    EXPECT_THAT(movie_arguments(movie, 64, 64, "b"), testing::Contains("iec61966-2-1")) << file;
  }
}

TEST(MovieArguments, GiveProResAChannelOfCoverage) {
  Movie movie;
  movie.file = "a.mov";
  movie.alpha = true;
  EXPECT_THAT(movie_arguments(movie, 64, 64, "b"), testing::Contains("yuva444p10le"));
  movie.alpha = false;
  EXPECT_THAT(movie_arguments(movie, 64, 64, "b"), testing::Contains("yuv444p10le"));
}

TEST(MovieArguments, TagThePicturesOfProRes) {
  Movie movie;
  movie.file = "a.mov";
  EXPECT_THAT(movie_arguments(movie, 64, 64, "b"),
              testing::Contains(HasSubstr("setparams=color_primaries=bt709:color_trc=iec61966-2-1")));
}

TEST_F(RenderAMovie, IsAnErrorWhenTheEncoderStopsReading) {
  install("exit 4\n");
  EXPECT_EQ(run("render small.toml --out f --size 512 --movie film.mp4 --backend cpu"), 1);
  EXPECT_THAT(output_, HasSubstr("film.mp4"));
}

TEST_F(RenderAMovie, LeavesNothingElseBehind) {
  install("exit 4\n");
  EXPECT_EQ(run("render small.toml --out f --movie films/film.mp4 --backend cpu"), 1);
  install_recorder();
  ASSERT_EQ(run("render small.toml --out f --resume --movie films/film.mp4 --backend cpu"), 0) << output_;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "films"), fs::directory_iterator()), 1);
}

TEST_F(RenderAMovie, IsRefusedBeforeAnyFrameIsMade) {
  install("exit 0\n");
  EXPECT_EQ(run("render small.toml --out f --movie film.avi"), 2);
  EXPECT_THAT(output_, HasSubstr(".mkv"));
  EXPECT_EQ(run("render small.toml --out f --format exr --movie film.mp4"), 2);
  EXPECT_THAT(output_, HasSubstr("EXR frames"));
  EXPECT_EQ(run("render small.toml --out f --movie small.toml/film.mp4"), 1);
  EXPECT_THAT(output_, HasSubstr("small.toml is not a folder"));
  EXPECT_EQ(run("render small.toml --out f --stereo rows --movie film.mp4"), 2);
  EXPECT_THAT(output_, HasSubstr("choose .mov or .mkv"));
  EXPECT_EQ(run("render small.toml --out f --movie ''"), 2);
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_EQ(run("render small.toml --out f --movie film.mp4"), 1);
  EXPECT_THAT(output_, HasSubstr("install ffmpeg"));
  EXPECT_FALSE(fs::exists(folder_ / "f"));
}

TEST_F(CommandLine, ASequenceHasASheetOfFactsForPeopleAndForPrograms) {
  write("small.toml", movie_show);
  ASSERT_EQ(run("render small.toml --out f --format exr --compression dwaa --fps 24 --backend cpu"), 0) << output_;
  std::ostringstream json;
  json << std::ifstream(folder_ / "f/small.json").rdbuf();
  EXPECT_THAT(json.str(), HasSubstr("\"frame_rate_hz\": 24.0"));
  EXPECT_THAT(json.str(), HasSubstr("\"compression\": \"dwaa\""));
  EXPECT_THAT(json.str(), HasSubstr("\"frames\": 2"));
  std::ostringstream text;
  text << std::ifstream(folder_ / "f/small.txt").rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("frame_rate_hz: 24.0\n"));
  EXPECT_THAT(text.str(), HasSubstr("projection: dome\n"));
}

TEST_F(CommandLine, ASheetOfFactsTellsOfTheFramesThatLieThere) {
  write("zoom.toml",
        "duration_s = 2\nframe_rate_hz = 10\n[[camera.key]]\nr = 9\n[sky]\nmap = \"black\"\n[view]\nsize_px = 16\n"
        "[[animate]]\nnumber = \"view.fov_deg\"\nkey = [{ t_s = 0, value = 100, ease = \"linear\" }, { t_s = 2, value "
        "= 120 }]\n");
  const auto metadata = [&] {
    std::ifstream file(folder_ / "f/zoom.json");
    return nlohmann::json::parse(file);
  };
  ASSERT_EQ(run("render zoom.toml --out f --backend cpu --lens direct --frames 6:8"), 0) << output_;
  const nlohmann::json part = metadata();
  EXPECT_EQ(part["files"], "zoom_000006.png");
  EXPECT_EQ(part["frames"], 3);
  EXPECT_EQ(part["first_frame"], 6);
  EXPECT_EQ(part["last_frame"], 8);
  EXPECT_EQ(part["frames_of_show"], 20);
  EXPECT_NEAR(part["duration_s"].get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(part["fov_deg"]["first"].get<double>(), 105.0, 0.6) << "frame 6 is shown from 0.5 s on";
  EXPECT_NEAR(part["fov_deg"]["last"].get<double>() - part["fov_deg"]["first"].get<double>(), 2.0, 1e-9);
  ASSERT_EQ(run("render zoom.toml --out f --backend cpu --lens direct --frames 9:10"), 0) << output_;
  EXPECT_EQ(metadata()["first_frame"], 6) << "the parts lie beside each other";
  EXPECT_EQ(metadata()["frames"], 5);
}

TEST_F(CommandLine, ASheetOfFactsLeavesOutFramesThatWereAskedForOtherwise) {
  write("still.toml",
        "duration_s = 1\nframe_rate_hz = 8\n[[camera.key]]\nr = 9\n[sky]\nmap = \"black\"\n[view]\nsize_px = 16\n");
  const auto metadata = [&] {
    std::ifstream file(folder_ / "f/still.json");
    return nlohmann::json::parse(file);
  };
  ASSERT_EQ(run("render still.toml --out f --backend cpu --lens direct --frames 1:4"), 0) << output_;
  ASSERT_EQ(run("render still.toml --out f --backend cpu --lens direct --frames 5:8 --size 32"), 0) << output_;
  EXPECT_EQ(metadata()["eye_width_px"], 32);
  EXPECT_EQ(metadata()["first_frame"], 5);
  EXPECT_EQ(metadata()["frames"], 4);
}

TEST_F(CommandLine, PatternsNeedNoShow) {
  ASSERT_EQ(run("render --pattern all --size 64 --out p"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "p/orientation.png"));
  EXPECT_TRUE(fs::exists(folder_ / "p/black.png"));
  ASSERT_EQ(run("render --pattern left_right --stereo separate --projection pinhole --size 64 --out p"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "p/L/left_right.png"));
  EXPECT_TRUE(fs::exists(folder_ / "p/R/left_right.png"));
  EXPECT_EQ(run("render --pattern chequers"), 2);
  EXPECT_EQ(run("render"), 2);
}

}  // namespace
}  // namespace ergodome::test
