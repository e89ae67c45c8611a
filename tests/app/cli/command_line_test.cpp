#include "tests/app/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "kernels/launch/instruction_set.h"
#include "kernels/launch/launch.h"
#include "render/output/image_reader.h"
#include "render/output/image_writer.h"
#include "tests/support/sanitized.h"

// Tests that run the program as a user would.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::CommandLine;
using testing::HasSubstr;

constexpr const char* small_show = R"(
title = "Small"
duration_s = 0.1
[hole]
spin = 0.9
[camera]
[[camera.key]]
r = 8
[sky]
map = "sky.ppm"
[view]
size_px = 64
)";

TEST_F(CommandLine, EveryCommandAnswersHelp) {
  EXPECT_EQ(run("--help"), 0);
  for (const char* command :
       {"play", "render", "bake", "inspect", "plan", "catalogue", "calibrate", "trace", "edge", "connect"}) {
    EXPECT_EQ(run(std::string(command) + " --help"), 0) << command;
    EXPECT_THAT(output_, HasSubstr("--help"));
  }
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(output_, HasSubstr(ERGODOME_VERSION));
}

TEST_F(CommandLine, WrongWordsAreOneLineAndNotZero) {
  for (const char* words : {"", "fly", "render", "trace --rays x.csv", "render a --size 0", "render a --size 99999",
                            "trace --rays a --out b --method guess"}) {
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
}

TEST_F(CommandLine, NumbersThatAreNoneAreOneLineAndNotZero) {
  write("empty.csv", "ra_deg,dec_deg,v_mag\n");
  for (const char* arguments :
       {"render once-around --fps nan", "plan once-around --measure --time nan", "catalogue empty.csv --faintest nan",
        "trace --rays rays.csv --out t.csv --tolerance nan", "convert a.mpcdi y.toml --radius nan",
        "inspect once-around --picture o.png --time nan"}) {
    EXPECT_NE(run(arguments), 0) << arguments;
    EXPECT_THAT(output_, testing::HasSubstr("\"nan\" is not a number from")) << arguments;
    EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
  }
}

TEST_F(CommandLine, RenderWritesNumberedFramesAndResumesWhatIsMissing) {
  write("small.toml", small_show);
  ASSERT_EQ(run("render small.toml --out frames --backend cpu"), 0) << output_;
  for (const char* name : {"small_000001.png", "small_000002.png", "small_000003.png"}) {
    EXPECT_TRUE(is_complete_image(folder_ / "frames" / name, 64, 64)) << name;
  }
  fs::remove(folder_ / "frames/small_000002.png");
  fs::resize_file(folder_ / "frames/small_000003.png", 100);
  ASSERT_EQ(run("render small.toml --out frames --backend cpu --resume"), 0);
  EXPECT_THAT(output_, HasSubstr("2 frames"));
  EXPECT_TRUE(is_complete_image(folder_ / "frames/small_000003.png", 64, 64));
}

TEST_F(CommandLine, RenderHasExrStereoAndProjections) {
  write("small.toml", small_show);
  ASSERT_EQ(run("render small.toml --out f --frames 1 --format exr --stereo separate --backend cpu"), 0) << output_;
  EXPECT_TRUE(is_complete_image(folder_ / "f/L/small_000001.exr", 64, 64));
  EXPECT_TRUE(is_complete_image(folder_ / "f/R/small_000001.exr", 64, 64));
  ASSERT_EQ(run("render small.toml --out f --frames 2:2 --size 100 --stereo side_by_side --projection equirect "
                "--backend cpu"),
            0);
  EXPECT_TRUE(is_complete_image(folder_ / "f/small_000002.png", 200, 50));
  for (const char* view : {"steps", "error", "order", "g", "magnification"}) {
    if (test::sanitized && std::string_view(view) != "steps" && std::string_view(view) != "g") {
      continue;
    }
    EXPECT_EQ(run(std::string("render small.toml --out v --frames 1 --size 200 --view ") + view), 0) << view;
  }
  for (const char* method : {"taylor", "baseline_rk34"}) {
    EXPECT_EQ(run(std::string("render small.toml --out m --frames 1 --view steps --method ") + method), 0) << output_;
  }
  EXPECT_EQ(run("render small.toml --method rk34"), 2);
  EXPECT_THAT(output_, HasSubstr("add --view steps"));
}

TEST_F(CommandLine, RenderWritesEveryStereoLayoutAndResumesIt) {
  write("small.toml", small_show);
  const auto expect_image = [&](const std::string& layout, const std::string& options, int width, int height) {
    const std::string render = "render small.toml --frames 1 --backend cpu --out " + layout + " --stereo " + layout;
    ASSERT_EQ(run(render + options), 0) << output_;
    const std::string ending = layout == "multiview" ? "exr" : "png";
    const int parts = layout == "multiview" ? 2 : 1;
    EXPECT_TRUE(is_complete_image(folder_ / layout / ("small_000001." + ending), width, height, parts)) << layout;
    if (layout != "half_side_by_side" && layout != "half_top_bottom" && layout != "anaglyph") {
      ASSERT_EQ(run(render + options + " --resume"), 0) << output_;
      EXPECT_THAT(output_, HasSubstr("0 frames")) << layout;
    }
  };
  expect_image("multiview", " --format exr", 64, 64);
  expect_image("top_bottom", "", 64, 128);
  // Under sanitizers, starting the program takes a second each time, and tests of single frames
  // cover the same code; therefore only one layout is tested then.
  for (const char* layout : {"half_side_by_side", "half_top_bottom", "rows", "anaglyph", "dubois"}) {
    if (!test::sanitized || std::string_view(layout) == "rows") {
      expect_image(layout, "", 64, 64);
    }
  }
}

TEST_F(CommandLine, SwappingEyesSwapsTheirFiles) {
  const std::string show = std::string(small_show) + "[stereo]\nlayout = \"separate\"\nbaseline = 1\n";
  write("eyes.toml", show);
  ASSERT_EQ(run("render eyes.toml --out plain --frames 1 --backend cpu"), 0) << output_;
  write("eyes.toml", show + "swap_eyes = true\n");
  ASSERT_EQ(run("render eyes.toml --out swapped --frames 1 --backend cpu"), 0) << output_;
  const auto pixels = [&](const char* path) { return read_display_pixels(folder_ / path).values; };
  EXPECT_EQ(pixels("plain/L/eyes_000001.png"), pixels("swapped/R/eyes_000001.png"));
  EXPECT_EQ(pixels("plain/R/eyes_000001.png"), pixels("swapped/L/eyes_000001.png"));
  EXPECT_NE(pixels("plain/L/eyes_000001.png"), pixels("plain/R/eyes_000001.png"));
}

TEST_F(CommandLine, RenderHasCubesAndCylinders) {
  write("small.toml", small_show);
  ASSERT_EQ(run("render small.toml --out c --frames 1 --size 64 --projection cube --backend cpu"), 0) << output_;
  EXPECT_TRUE(is_complete_image(folder_ / "c/small_000001.png", 64, 48));
  ASSERT_EQ(run("render small.toml --out y --frames 1 --size 64 --projection cylinder --backend cpu"), 0) << output_;
  // A cylinder of radius 1 is 2 high for 90° (±45°) and 2π wide for 360°: 64 pixels of width need
  // 20 rows.
  EXPECT_TRUE(is_complete_image(folder_ / "y/small_000001.png", 64, 20));
}

TEST_F(CommandLine, RenderWritesAFileForEachFaceOfACube) {
  write("faces.toml", std::string(small_show) + "projection = \"cube\"\ncube_layout = \"faces\"\n");
  ASSERT_EQ(run("render faces.toml --out f --frames 1 --size 32 --stereo side_by_side --backend cpu"), 0) << output_;
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
    EXPECT_TRUE(is_complete_image(folder_ / "f" / (std::string("faces_000001_") + face + ".png"), 64, 32)) << face;
  }
  fs::remove(folder_ / "f/faces_000001_ny.png");
  ASSERT_EQ(run("render faces.toml --out f --frames 1 --size 32 --stereo side_by_side --backend cpu --resume"), 0);
  EXPECT_THAT(output_, HasSubstr("1 frame in"));
}

TEST_F(CommandLine, SaysHowRangesOfFramesAreWritten) {
  write("small.toml", small_show);
  for (const char* range : {"1-3", "1:3:2", "first"}) {
    EXPECT_EQ(run(std::string("render small.toml --frames ") + range), 2) << range;
    EXPECT_THAT(output_, HasSubstr("write FIRST:LAST")) << range;
  }
}

TEST_F(CommandLine, SaysThatAnOptionIsGivenTwice) {
  EXPECT_EQ(run("render once-around --frames 1 --frames 2"), 2);
  EXPECT_EQ(output_, "ergodome: --frames: was given 2 times; give it once\n");
}

TEST_F(CommandLine, RenderRefusesWhatCannotBeAndSaysWhy) {
  write("small.toml", small_show);
  EXPECT_EQ(run("render small.toml --frames 9:12"), 2);
  EXPECT_THAT(output_, HasSubstr("1:3"));
  EXPECT_EQ(run("render small.toml --frames 3:1"), 2);
  EXPECT_EQ(run("render absent"), 1);
  EXPECT_THAT(output_, HasSubstr("first-light"));
  EXPECT_EQ(run("render small.toml --out /proc/nowhere"), 1);
  write("bad.toml", std::string(small_show) + "[planets]\n");
  EXPECT_EQ(run("render bad.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("bad.toml:13"));
  write("near.toml", std::string(small_show) + "[stereo]\nlayout = \"rows\"\nconvergence = 5\n");
  EXPECT_EQ(run("render near.toml --projection equirect"), 1);
  EXPECT_THAT(output_, HasSubstr("stereo.convergence"));
  EXPECT_EQ(run("render small.toml --stereo multiview"), 2);
  EXPECT_THAT(output_, HasSubstr("--format exr"));
  EXPECT_EQ(run("render small.toml --stereo quad_buffer"), 2);
  EXPECT_THAT(output_, HasSubstr("--stereo"));
  write("map.toml", "[camera]\n[[camera.key]]\nr=9\n[sky]\nmap = \"absent.exr\"\n");
  EXPECT_EQ(run("render map.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("absent.exr"));
}

TEST_F(CommandLine, OptionsWithoutAUseForTheShowAreAStatusOfTheirOwn) {
  write("small.toml", small_show);
  for (const char* const options :
       {"--baseline 0.1", "--tint-eyes --size 8", "--tint-eyes --stereo mono", "--stream-memory 64", "--language de",
        "--objects trace", "--check 2", "--budget 1px,2px", "--setup dome.toml --alpha", "--movie film.avi"}) {
    EXPECT_EQ(run(std::string("render small.toml --out f ") + options), 2) << options;
    EXPECT_THAT(output_, HasSubstr(std::string(options, std::string_view(options).find(' ')))) << options;
  }
  EXPECT_FALSE(fs::exists(folder_ / "f"));
}

TEST_F(CommandLine, WithoutAGpuAutoSaysSoOnceAndCudaRefuses) {
  if (cuda_unavailable_reason() == nullptr) {
    GTEST_SKIP() << "there is a GPU";
  }
  write("small.toml", small_show);
  ASSERT_EQ(run("render small.toml --out f"), 0);
  EXPECT_EQ(output_.find("rendering on cpu"), output_.rfind("rendering on cpu"));
  EXPECT_THAT(output_, HasSubstr("rendering on cpu"));
  EXPECT_EQ(run("render small.toml --out f --backend cuda"), 1);
}

TEST_F(CommandLine, InspectTellsWhatIsInAShow) {
  ASSERT_EQ(run("inspect first-light"), 0);
  EXPECT_THAT(output_, HasSubstr("side_by_side"));
  ASSERT_EQ(run("inspect first-light --json"), 0);
  EXPECT_THAT(output_, HasSubstr("\"spin\": 0.999"));
}

TEST_F(CommandLine, PlayWithoutADisplaySaysSo) {
  const std::string no_display = "env -u DISPLAY -u WAYLAND_DISPLAY true; unset DISPLAY WAYLAND_DISPLAY";
  EXPECT_EQ(run("inspect free-flight"), 0);
  const std::string command = no_display + "; '" ERGODOME_PROGRAM "' play --for 1 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  char buffer[2048] = {};
  const std::size_t got = std::fread(buffer, 1, sizeof buffer - 1, pipe);
  EXPECT_EQ(WEXITSTATUS(::pclose(pipe)), 1);
  EXPECT_THAT(std::string(buffer, got), HasSubstr("display"));
}

class PlayInAWindow : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (std::system("command -v xvfb-run >/dev/null") != 0) {
      GTEST_SKIP() << "no virtual display here (xvfb-run)";
    }
  }

  //! Plays with the given options and saves the last picture as shot.png.
  void play(const std::string& options) const {
    // The leak checker is off: OpenGL drivers leak memory, and they are unloaded before the leak
    // checker could attribute the leaks to them.
    const std::string command =
        "cd '" + folder_.string() +
        "' && ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 xvfb-run -a -s '-screen 0 800x600x24' '" ERGODOME_PROGRAM
        "' play dome-still --stereo mono --backend cpu --screenshot shot.png " +
        options + " 2>&1";
    FILE* pipe = ::popen(command.c_str(), "r");
    char buffer[2048] = {};
    const std::size_t got = std::fread(buffer, 1, sizeof buffer - 1, pipe);
    ASSERT_EQ(WEXITSTATUS(::pclose(pipe)), 0) << std::string(buffer, got);
  }
};

TEST_F(PlayInAWindow, ShowsAPicture) {
  play("--size 256 --for 3");
  EXPECT_TRUE(is_complete_image(folder_ / "shot.png", 256, 256));
  // The compressed file of a black picture would be smaller than that of a picture of the sky.
  EXPECT_GT(fs::file_size(folder_ / "shot.png"), 5000U);
}

TEST_F(PlayInAWindow, TakesPicturesSmallerThanItsOwnSmallest) {
  play("--size 32 --for 0.5 --times");
  EXPECT_TRUE(fs::exists(folder_ / "shot.png"));
}

TEST_F(PlayInAWindow, SaysThatEyesOfSeparateFilesAreSideBySide) {
  write("small.toml", small_show);
  ASSERT_EQ(run_on_display("play small.toml --stereo separate --baseline 0.1 --backend cpu --no-sound --for 0.3", ""),
            0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("the window shows stereo layout separate side by side"));
}

TEST_F(CommandLine, InspectDrawsTheGridOfAShowAtATime) {
  write("small.toml", small_show);
  ASSERT_EQ(run("inspect small.toml --picture grid.png --size 48 --time 0.05"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("lens grid at r = 8 M"));
  EXPECT_TRUE(is_complete_image(folder_ / "grid.png", 48, 48));
  EXPECT_NE(run("inspect small.toml --picture /dev/null/x.png --size 48"), 0);
  EXPECT_NE(run("inspect small.toml --picture grid.png --size 1"), 0);
}

TEST_F(CommandLine, WrongGridSettingsAreOneLineAndLeaveNoFile) {
  const std::string rays = ERGODOME_TEST_DATA_DIR "/rays.csv";
  for (const char* words :
       {"--method grid --budget foo", "--method grid --budget -1px", "--method quadtree --level 99"}) {
    EXPECT_NE(run("trace --rays '" + rays + "' --out out.csv " + words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
    EXPECT_FALSE(fs::exists(folder_ / "out.csv")) << words;
  }
}

}  // namespace
}  // namespace ergodome
