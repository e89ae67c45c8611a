#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "render/output/image_reader.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::HasSubstr;

constexpr const char* setup_of_two =
    "[dome]\nradius_m = 6\n"
    "[[projector]]\nname = \"left / one\"\nyaw_deg = -40\npitch_deg = 40\n"
    "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [64, 48]\n"
    "window_px = [0, 0]\n"
    "[[projector]]\nname = \"left _ one\"\nyaw_deg = 40\npitch_deg = 40\n"
    "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [80, 40]\n"
    "window_px = [64, 0]\n";

constexpr const char* show_on_dome =
    "duration_s = 0.1\n[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 8\n[sky]\nmap = \"sky.png\"\n";

//! Runs commands (render, play, calibrate) with a setup of two projectors, headless or on a virtual
//! display.
class SetupCommands : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    // The leak checker is off: OpenGL drivers leak memory, and they are unloaded before the leak
    // checker could attribute the leaks to them.
    const char* const options = std::getenv("ASAN_OPTIONS");
    ::setenv("ASAN_OPTIONS", ((options != nullptr ? std::string(options) : "") + ":detect_leaks=0").c_str(), 1);
    write("dome.toml", setup_of_two);
    write("show.toml", show_on_dome);
    write_png(folder_ / "sky.png", std::vector<std::uint8_t>(3 * 32 * 16, 128), 32, 16);
  }

  //! Runs the program; returns false if there is no OpenGL driver.
  bool run_headless(const std::string& words) {
    const int code = run(words);
    if (output_.find("EGL: no driver") != std::string::npos) {
      return false;
    }
    EXPECT_EQ(code, 0) << output_;
    return true;
  }

  //! Runs the program on a virtual display of 800 x 600; skips the test if there is none.
  void run_on_display(const std::string& words) {
    if (std::system("command -v xvfb-run >/dev/null") != 0) {
      GTEST_SKIP() << "no virtual display here (xvfb-run)";
    }
    const std::string command = "cd '" + folder_.string() +
                                "' && xvfb-run -a -s '-screen 0 800x600x24' '" ERGODOME_PROGRAM "' " + words + " 2>&1";
    FILE* pipe = ::popen(command.c_str(), "r");
    char buffer[4096] = {};
    output_.assign(buffer, std::fread(buffer, 1, sizeof buffer, pipe));
    code_ = WEXITSTATUS(::pclose(pipe));
  }

  [[nodiscard]] bool is_frame(const std::string& name, int width, int height) const {
    return is_complete_image(folder_ / name, width, height);
  }

  int code_ = -1;
};

TEST_F(SetupCommands, RenderWritesAFrameForEachProjector) {
  if (!run_headless("render show.toml --setup dome.toml --out f --frames 1 --size 128")) {
    GTEST_SKIP() << output_;
  }
  EXPECT_TRUE(is_frame("f/show_000001_left___one.png", 64, 48));
  EXPECT_TRUE(is_frame("f/show_000001_left___one_2.png", 80, 40));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f/show_000001.png"));
}

TEST_F(SetupCommands, RenderGoesOnWhereProjectorsAreMissing) {
  if (!run_headless("render show.toml --setup dome.toml --out f --frames 1:2 --size 128")) {
    GTEST_SKIP() << output_;
  }
  std::filesystem::remove(folder_ / "f/show_000002_left___one_2.png");
  ASSERT_TRUE(run_headless("render show.toml --setup dome.toml --out f --frames 1:2 --size 128 --resume"));
  EXPECT_THAT(output_, HasSubstr("1 frame in f"));
}

TEST_F(SetupCommands, RenderWritesPatternsForEachProjector) {
  if (!run_headless("render --pattern all --setup dome.toml --out p --size 128")) {
    GTEST_SKIP() << output_;
  }
  EXPECT_TRUE(is_frame("p/polar_grid_left___one.png", 64, 48));
  EXPECT_TRUE(is_frame("p/number_left___one_2.png", 80, 40));
}

TEST_F(SetupCommands, RefuseWhatProjectorsCannotShow) {
  write("none.toml", "[dome]\nradius_m = 6\n");
  write("away.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"p\"\nresolution_px = [64, 48]\nwarp = \"a.data\"\n");
  write("a.data", "2\n2 2\n-1 -1 3 3 1\n1 -1 4 3 1\n-1 1 3 4 1\n1 1 4 4 1\n");
  for (const char* words :
       {"render show.toml --setup none.toml", "render show.toml --setup nothing.toml",
        "render show.toml --setup away.toml", "render show.toml --setup dome.toml --format exr",
        "render show.toml --setup dome.toml --alpha", "render show.toml --setup dome.toml --movie a.mp4",
        "render show.toml --setup dome.toml --stereo side_by_side", "play show.toml --setup none.toml",
        "calibrate none.toml --live", "calibrate away.toml --live", "calibrate dome.toml"}) {
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
  run("render show.toml --setup away.toml");
  EXPECT_THAT(output_, HasSubstr("projector p: has a warp that shows no part of the domemaster"));
}

TEST_F(SetupCommands, AStereoLayoutThatProjectorsCannotTakeApartIsTheCommandLinesFault) {
  for (const char* words : {"render show.toml --setup dome.toml --stereo side_by_side",
                            "render --pattern white --setup dome.toml --stereo side_by_side",
                            "play show.toml --setup dome.toml --stereo side_by_side"}) {
    EXPECT_EQ(run(words), 2) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: --stereo side_by_side: puts both eyes into one picture")) << words;
  }
}

TEST_F(SetupCommands, AStereoLayoutOfAShowThatProjectorsCannotTakeApartIsTheShows) {
  write("show.toml", std::string(show_on_dome) + "[stereo]\nlayout = \"side_by_side\"\n");
  EXPECT_EQ(run("render show.toml --setup dome.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("show.toml: puts both eyes into one picture"));
}

TEST_F(SetupCommands, PlayOpensAWindowForEachProjector) {
  run_on_display("play show.toml --setup dome.toml --backend cpu --size 128 --for 1 --screenshot shot.png");
  if (IsSkipped()) {
    return;
  }
  ASSERT_EQ(code_, 0) << output_;
  EXPECT_TRUE(is_frame("shot_left___one.png", 64, 48));
  EXPECT_TRUE(is_frame("shot_left___one_2.png", 80, 40));
}

TEST_F(SetupCommands, PlayKeepsCaptionsSharpOnProjectorsOfASmallMaster) {
  write("dome.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"p\"\npitch_deg = 40\n"
        "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [400, 300]\n"
        "window_px = [0, 0]\n");
  // Far from the hole and with a gray sky, everything but the caption is independent of the
  // resolution.
  write("show.toml",
        "duration_s = 100\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 900\n[sky]\nmap = \"sky.png\"\n"
        "[[caption]]\ntext = \"HHHHH\"\nfrom_s = 0\nto_s = 100\nfade_in_s = 0\nletter_deg = 12\nelevation_deg = 40\n");
  for (const char* words : {"--screenshot fine.png", "--size 48 --screenshot coarse.png"}) {
    run_on_display(std::string("play show.toml --setup dome.toml --backend cpu --for 2 ") + words);
    if (IsSkipped()) {
      return;
    }
    ASSERT_EQ(code_, 0) << output_;
  }
  const DisplayPixels fine = read_display_pixels(folder_ / "fine_p.png");
  const DisplayPixels coarse = read_display_pixels(folder_ / "coarse_p.png");
  ASSERT_EQ(fine.values.size(), 3U * 400 * 300);
  ASSERT_EQ(coarse.values.size(), 3U * 400 * 300);
  int far_off = 0;
  int bright = 0;
  int dark = 0;
  // In this rectangle around the caption, the gray sky has values near 120.
  for (std::size_t y = 100; y < 200; ++y) {
    for (std::size_t x = 100; x < 300; ++x) {
      const int value = coarse.values[3 * (400 * y + x)] / 257;
      far_off += std::abs(value - fine.values[3 * (400 * y + x)] / 257) > 40 ? 1 : 0;
      bright += value > 220 ? 1 : 0;
      dark += value < 40 ? 1 : 0;
    }
  }
  EXPECT_GT(bright, 300) << "the letters";
  EXPECT_GT(dark, 300) << "their rim";
  // If the letters were drawn in the domemaster of 48 pixels, 2,463 of these pixels would differ.
  EXPECT_LT(far_off, 50);
}

TEST_F(SetupCommands, CalibrateLiveShowsPatternsOnEachProjector) {
  run_on_display("calibrate dome.toml --live --size 128 --for 1 --screenshot live.png");
  if (IsSkipped()) {
    return;
  }
  ASSERT_EQ(code_, 0) << output_;
  EXPECT_TRUE(is_frame("live_left___one.png", 64, 48));
  EXPECT_TRUE(is_frame("live_left___one_2.png", 80, 40));
}

TEST_F(SetupCommands, MissingMonitorsAreToldWithThoseThatThereAre) {
  std::string far = setup_of_two;
  far.replace(far.find("window_px = [0, 0]"), 18, "monitor = 7");
  write("far.toml", far);
  run_on_display("play show.toml --setup far.toml --for 1");
  if (IsSkipped()) {
    return;
  }
  EXPECT_NE(code_, 0);
  EXPECT_THAT(output_, testing::ContainsRegex(
                           "far.toml:[0-9]+, projector left / one: there is no monitor 7; choose from 0 \\("));
}

TEST_F(SetupCommands, WindowsBesideAllMonitorsAreRefused) {
  std::string far = setup_of_two;
  far.replace(far.find("window_px = [64, 0]"), 19, "window_px = [5000, 0]");
  write("far.toml", far);
  run_on_display("calibrate far.toml --live --for 1");
  if (IsSkipped()) {
    return;
  }
  EXPECT_NE(code_, 0);
  EXPECT_THAT(output_, HasSubstr("projector left _ one: no monitor shows its window, 80 x 40 pixels at window_px = "
                                 "[5000, 0]; move it to 0 ("));
  EXPECT_THAT(output_, HasSubstr("800 x 600 at 0, 0)"));
}

TEST_F(SetupCommands, WithoutADisplaySayWhatToDo) {
  for (const char* words : {"play show.toml --setup dome.toml --for 0.1", "calibrate dome.toml --live --for 0.1"}) {
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("start it on a machine with a display")) << words;
  }
}

}  // namespace
}  // namespace ergodome
