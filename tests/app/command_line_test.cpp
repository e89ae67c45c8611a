#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "kernels/launch/instruction_set.h"
#include "render/output/image_writer.h"
#include "tests/support/csv_table.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

// The program as a person runs it.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CommandLine : public test::FolderTest {
 protected:
  //! Runs the program in the test's folder; all that it prints goes to output_.
  int run(const std::string& arguments) {
    const std::string command = "cd '" + folder_.string() + "' && '" ERGODOME_PROGRAM "' " + arguments + " 2>&1";
    FILE* pipe = ::popen(command.c_str(), "r");
    output_.clear();
    char buffer[4096];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
      output_.append(buffer, got);
    }
    const int status = ::pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::string output_;
};

constexpr const char* small_show = R"(
title = "Small"
duration_s = 0.1
[hole]
spin = 0.9
[camera]
[[camera.key]]
r = 8
[sky]
map = "grid"
[view]
size_px = 64
)";

TEST_F(CommandLine, EveryCommandAnswersHelp) {
  EXPECT_EQ(run("--help"), 0);
  for (const char* command : {"play", "render", "bake", "inspect", "trace", "edge"}) {
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

TEST_F(CommandLine, TraceGivesTheReferenceForEveryRayByEveryExactMethod) {
  const std::string rays = ERGODOME_TEST_DATA_DIR "/rays.csv";
  const auto expected = test::read_csv(rays);
  for (const char* method : {"taylor", "closed_form"}) {
    ASSERT_EQ(run("trace --rays '" + rays + "' --out out.csv --method " + method), 0) << output_;
    const auto traced = test::read_csv(folder_ / "out.csv");
    ASSERT_EQ(traced.size(), expected.size());
    for (std::size_t i = 0; i < traced.size(); ++i) {
      const auto& want = expected[i];
      const auto& got = traced[i];
      ASSERT_EQ(got.at("id"), want.at("id"));
      ASSERT_EQ(got.at("status"), want.at("status")) << method << " " << want.at("id");
      const double g = std::stod(want.at("g"));
      EXPECT_NEAR(std::stod(got.at("g")), g, 1e-12 * std::abs(g)) << method << " " << want.at("id");
      if (want.at("status") == "escaped") {
        const auto difference = [&](const char* axis) { return std::stod(got.at(axis)) - std::stod(want.at(axis)); };
        const double error = std::hypot(difference("sky_x"), difference("sky_y"), difference("sky_z"));
        EXPECT_LT(error, 1e-10 + 1e-13 / std::abs(std::stod(want.at("edge_distance"))))
            << method << " " << want.at("id");
      }
    }
  }
}

TEST_F(CommandLine, TraceWorksByEveryMethodInBothPrecisions) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,6,1.2,zamo,-0.2,0.3,0.9\n0.9,6,1.2,zamo,-1,0,0\n");
  for (const char* method : {"taylor", "rk34", "cash_karp", "closed_form", "baseline_rk34"}) {
    for (const char* precision : {"float", "double"}) {
      ASSERT_EQ(run(std::string("trace --rays rays.csv --out out.csv --tolerance 1e-5 --method ") + method +
                    " --precision " + precision),
                0)
          << output_;
      const auto rows = test::read_csv(folder_ / "out.csv");
      ASSERT_EQ(rows.size(), 2U);
      EXPECT_EQ(rows[0].at("status"), "escaped") << method;
      EXPECT_EQ(rows[1].at("status"), "captured") << method;
      EXPECT_EQ(rows[1].at("sky_x"), "");
    }
  }
}

TEST_F(CommandLine, EdgeOfTheReferencePointsIsNowhere) {
  ASSERT_EQ(run("edge --rays '" ERGODOME_TEST_DATA_DIR "/edge.csv' --out out.csv"), 0) << output_;
  const auto rows = test::read_csv(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), 1088U);
  for (const auto& row : rows) {
    EXPECT_LT(std::abs(std::stod(row.at("edge_distance"))), 1e-10);
  }
}

TEST_F(CommandLine, EdgeWritesPointsThatLieOnTheEdge) {
  write("camera.csv", "id,a,r,theta,observer,n_r,n_theta,n_phi\nmy camera,0.9,6,1.2,rain,1,0,0\n");
  ASSERT_EQ(run("edge --rays camera.csv --out points.csv --points 8"), 0) << output_;
  const auto points = test::read_csv(folder_ / "points.csv");
  ASSERT_EQ(points.size(), 8U);
  EXPECT_EQ(points[3].at("id"), "my camera");
  std::string rays = "a,r,theta,observer,n_r,n_theta,n_phi\n";
  for (const auto& point : points) {
    rays += "0.9,6,1.2,rain," + point.at("n_r") + "," + point.at("n_theta") + "," + point.at("n_phi") + "\n";
  }
  write("rays.csv", rays);
  ASSERT_EQ(run("edge --rays rays.csv --out out.csv"), 0);
  for (const auto& row : test::read_csv(folder_ / "out.csv")) {
    EXPECT_LT(std::abs(std::stod(row.at("edge_distance"))), 1e-13);
  }
}

TEST_F(CommandLine, ProblemsInATableNameTheLineAndLeaveNoFile) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,0.5,1.2,zamo,1,0,0\n");
  EXPECT_EQ(run("trace --rays rays.csv --out out.csv"), 1);
  EXPECT_THAT(output_, HasSubstr("rays.csv:2"));
  EXPECT_FALSE(fs::exists(folder_ / "out.csv"));
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
    EXPECT_EQ(run(std::string("render small.toml --out v --frames 1 --size 200 --view ") + view), 0) << view;
  }
}

TEST_F(CommandLine, RenderRefusesWhatCannotBeAndSaysWhy) {
  write("small.toml", small_show);
  EXPECT_EQ(run("render small.toml --frames 9:12"), 1);
  EXPECT_THAT(output_, HasSubstr("1:3"));
  EXPECT_EQ(run("render small.toml --frames 3:1"), 1);
  EXPECT_EQ(run("render absent"), 1);
  EXPECT_THAT(output_, HasSubstr("first-light"));
  EXPECT_EQ(run("render small.toml --out /proc/nowhere"), 1);
  write("bad.toml", std::string(small_show) + "[stars]\n");
  EXPECT_EQ(run("render bad.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("bad.toml:13"));
  write("stars.toml", std::string(small_show) + "[effects]\npsf = { sigma_px = 0.5 }\n");
  EXPECT_EQ(run("render stars.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("not drawn yet"));
  write("map.toml", "[camera]\n[[camera.key]]\nr=9\n[sky]\nmap = \"absent.exr\"\n");
  EXPECT_EQ(run("render map.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("absent.exr"));
}

TEST_F(CommandLine, WithoutAGpuAutoSaysSoOnceAndCudaRefuses) {
  if (cuda_unavailable_reason() == nullptr) {
    GTEST_SKIP() << "there is a GPU";
  }
  write("small.toml", small_show);
  ASSERT_EQ(run("render small.toml --out f"), 0);
  EXPECT_EQ(output_.find("no GPU"), output_.rfind("no GPU"));
  EXPECT_THAT(output_, HasSubstr("no GPU"));
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

  //! Plays with the options given and leaves the last picture in shot.png.
  void play(const std::string& options) const {
    // Drivers keep memory; whose it is cannot be told once they are unloaded.
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
  // A picture of the sky is no black square.
  EXPECT_GT(fs::file_size(folder_ / "shot.png"), 5000U);
}

TEST_F(PlayInAWindow, TakesPicturesSmallerThanItsOwnSmallest) {
  play("--size 32 --for 0.5 --times");
  EXPECT_TRUE(fs::exists(folder_ / "shot.png"));
}

constexpr const char* moving_show = R"(
title = "Moving"
duration_s = 10
[hole]
spin = 0.9
[camera]
[[camera.key]]
t_s = 0
r = 12
theta_deg = 60
[[camera.key]]
t_s = 10
r = 5
theta_deg = 100
[sky]
map = "grid"
[view]
size_px = 512
[stereo]
layout = "side_by_side"
baseline = 0.05
)";

class BakeCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("moving.toml", moving_show);
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream from(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
  }

  //! Starts the program without waiting for it.
  [[nodiscard]] pid_t start(std::vector<std::string> words) const {
    const pid_t child = ::fork();
    if (child == 0) {
      std::vector<char*> arguments;
      arguments.reserve(words.size() + 1);
      for (std::string& word : words) {
        arguments.push_back(word.data());
      }
      arguments.push_back(nullptr);
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      if (::chdir(folder_.c_str()) == 0) {
        ::execv(ERGODOME_PROGRAM, arguments.data());
      }
      ::_exit(127);
    }
    return child;
  }
};

TEST_F(BakeCommand, BakesOnceAndTellsWhatItMade) {
  ASSERT_EQ(run("bake moving.toml --out moving.trajectory"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("stations"));
  EXPECT_FALSE(fs::exists(folder_ / "moving.trajectory.part"));
  ASSERT_EQ(run("bake moving.toml --out moving.trajectory"), 0);
  EXPECT_THAT(output_, HasSubstr("is baked already"));
  ASSERT_EQ(run("inspect moving.trajectory --picture grid.png --size 64 --time 5"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("blending"));
  EXPECT_TRUE(is_complete_image(folder_ / "grid.png", 64, 64));
}

TEST_F(BakeCommand, KilledFiftyTimesTheFileIsTheSame) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for many minutes";
  }
  ASSERT_EQ(run("bake moving.toml --out whole.trajectory --no-derivatives --budget 0.05"), 0) << output_;
  std::mt19937 random(11);
  int killed = 0;
  int finished = 0;
  constexpr int wanted = 50;
  while (killed < wanted && finished < 20 * wanted) {
    const pid_t child = start(
        {"ergodome", "bake", "moving.toml", "--out", "killed.trajectory", "--no-derivatives", "--budget", "0.05"});
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 80'000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) {
      ++killed;
    } else {
      ++finished;
      ASSERT_EQ(WEXITSTATUS(status), 0);
      EXPECT_TRUE(text_of("killed.trajectory") == text_of("whole.trajectory"));
      fs::remove(folder_ / "killed.trajectory");
    }
  }
  EXPECT_EQ(killed, wanted);
  ASSERT_EQ(run("bake moving.toml --out killed.trajectory --no-derivatives --budget 0.05"), 0) << output_;
  EXPECT_TRUE(text_of("killed.trajectory") == text_of("whole.trajectory"));
  // Nothing else is left behind.
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_TRUE(entry.path().extension() == ".trajectory" || entry.path().extension() == ".toml") << entry.path();
  }
}

TEST_F(BakeCommand, PartsOfSeveralProcessesJoinToTheSameFile) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for minutes";
  }
  ASSERT_EQ(run("bake moving.toml --out whole.trajectory"), 0) << output_;
  std::vector<pid_t> children;
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    children.push_back(start({"ergodome", "bake", "moving.toml", "--out", "joined.trajectory", "--part", part}));
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
  }
  ASSERT_EQ(run("bake moving.toml --out joined.trajectory"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("(0 built now)"));
  EXPECT_TRUE(text_of("joined.trajectory") == text_of("whole.trajectory"));
  EXPECT_FALSE(fs::exists(folder_ / "joined.trajectory.part-1-of-3"));
}

TEST_F(BakeCommand, RenderStreamsFromTheFileBesideTheShowAndSkipsABadStation) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for minutes";
  }
  ASSERT_EQ(run("bake moving.toml --out moving.trajectory"), 0) << output_;
  ASSERT_EQ(run("render moving.toml --size 64 --frames 100:101 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("streamed: 4 lenses"));
  std::string bytes = text_of("moving.trajectory");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 16);
  write("moving.trajectory", bytes);
  EXPECT_NE(run("inspect moving.trajectory"), 0);
  EXPECT_THAT(output_, HasSubstr(": station "));
  ASSERT_EQ(run("render moving.toml --size 64 --frames 150:155 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("(skipped)"));
  EXPECT_EQ(output_.find("(skipped)"), output_.rfind("(skipped)"));
  EXPECT_THAT(output_, HasSubstr("1 bad"));
}

TEST_F(BakeCommand, WhatDoesNotFitIsRefusedInWords) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for minutes";
  }
  write("other.toml", std::string(moving_show).replace(std::string(moving_show).find("r = 5"), 5, "r = 6"));
  ASSERT_EQ(run("bake moving.toml --out moving.trajectory"), 0) << output_;
  EXPECT_NE(run("render other.toml --size 16 --frames 1 --trajectory moving.trajectory"), 0);
  EXPECT_THAT(output_, HasSubstr("another camera path"));
  fs::rename(folder_ / "moving.trajectory", folder_ / "other.trajectory");
  EXPECT_EQ(run("render other.toml --size 16 --frames 1"), 0);
  EXPECT_THAT(output_, HasSubstr("left alone"));
  EXPECT_NE(run("render moving.toml --size 16 --frames 1 --lens streamed"), 0);
  EXPECT_THAT(output_, HasSubstr("no trajectory"));
  EXPECT_NE(run("render moving.toml --size 16 --frames 1 --trajectory moving.toml"), 0);
  EXPECT_THAT(output_, HasSubstr("is not a trajectory"));
  EXPECT_NE(run("bake moving.toml --out /dev/null/x"), 0);
  EXPECT_NE(run("bake moving.toml --out m --part 3/2"), 0);
  EXPECT_THAT(output_, HasSubstr("no part of a bake"));
  EXPECT_NE(run("bake moving.toml --out m --budget 0"), 0);
  write("quadtree.toml", std::string(moving_show) + "[grid]\nscheme = \"quadtree\"\n");
  EXPECT_NE(run("bake quadtree.toml --out q"), 0);
  EXPECT_THAT(output_, HasSubstr("is not baked"));
  write("half.part", "title");
  EXPECT_NE(run("bake moving.toml --out half"), 0);
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
