#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/command_line.h"

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

//! A stand-in for ffmpeg, first on the path: it notes its words, and keeps what it is sent as the film.
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

TEST_F(RenderAMovie, IsAnErrorWhenTheEncoderStopsReading) {
  install("exit 4\n");
  EXPECT_EQ(run("render small.toml --out f --size 512 --movie film.mp4 --backend cpu"), 1);
  EXPECT_THAT(output_, HasSubstr("film.mp4"));
}

TEST_F(RenderAMovie, LeavesNothingElseBehind) {
  install("exit 4\n");
  EXPECT_EQ(run("render small.toml --out f --movie films/film.mp4 --backend cpu"), 1);
  install_recorder();
  fs::create_directory(folder_ / "films");
  ASSERT_EQ(run("render small.toml --out f --resume --movie films/film.mp4 --backend cpu"), 0) << output_;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "films"), fs::directory_iterator()), 1);
}

TEST_F(RenderAMovie, IsRefusedBeforeAnyFrameIsMade) {
  install("exit 0\n");
  EXPECT_EQ(run("render small.toml --out f --movie film.avi"), 1);
  EXPECT_THAT(output_, HasSubstr(".mkv"));
  EXPECT_EQ(run("render small.toml --out f --format exr --movie film.mp4"), 1);
  EXPECT_THAT(output_, HasSubstr("linear light"));
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
  const auto facts = [&] {
    std::ifstream file(folder_ / "f/zoom.json");
    return nlohmann::json::parse(file);
  };
  ASSERT_EQ(run("render zoom.toml --out f --backend cpu --lens direct --frames 6:8"), 0) << output_;
  const nlohmann::json part = facts();
  EXPECT_EQ(part["files"], "zoom_000006.png");
  EXPECT_EQ(part["frames"], 3);
  EXPECT_EQ(part["first_frame"], 6);
  EXPECT_EQ(part["last_frame"], 8);
  EXPECT_EQ(part["frames_of_show"], 20);
  EXPECT_NEAR(part["duration_s"].get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(part["fov_deg"]["first"].get<double>(), 105.0, 0.6) << "frame 6 is shown from 0.5 s on";
  EXPECT_NEAR(part["fov_deg"]["last"].get<double>() - part["fov_deg"]["first"].get<double>(), 2.0, 1e-9);
  ASSERT_EQ(run("render zoom.toml --out f --backend cpu --lens direct --frames 9:10"), 0) << output_;
  EXPECT_EQ(facts()["first_frame"], 6) << "the parts lie beside each other";
  EXPECT_EQ(facts()["frames"], 5);
}

TEST_F(CommandLine, PatternsNeedNoShow) {
  ASSERT_EQ(run("render --pattern all --size 64 --out p"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "p/orientation.png"));
  EXPECT_TRUE(fs::exists(folder_ / "p/black.png"));
  ASSERT_EQ(run("render --pattern left_right --stereo separate --projection pinhole --size 64 --out p"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "p/L/left_right.png"));
  EXPECT_TRUE(fs::exists(folder_ / "p/R/left_right.png"));
  EXPECT_EQ(run("render --pattern chequers"), 2);
  EXPECT_EQ(run("render"), 1);
}

}  // namespace
}  // namespace ergodome::test
