#include "app/commands/render/numbered_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "render/output/frame_files.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"

// Tests of frames that already exist in a folder, and of their metadata.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* numbered_show = R"(duration_s = 0.6
frame_rate_hz = 10
[[camera.key]]
r = 9
phi_deg = 350
yaw_deg = 90
[[camera.key]]
t_s = 0.6
r = 9
phi_deg = 380
yaw_deg = 90
[sky]
map = "black"
[view]
size_px = 16
tilt_deg = 20
[tone]
curve = "reinhard"
white = 3
[[animate]]
number = "tone.exposure_stops"
key = [{ t_s = 0, value = 0, ease = "linear" }, { t_s = 0.6, value = -6 }]
)";

class NumberedFrames : public test::CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("still.toml", numbered_show);
  }
  int render(const std::string& options) {
    return run("render still.toml --out f --backend cpu --lens direct " + options);
  }
  [[nodiscard]] std::string entry(const char* name) const {
    return metadata_of_image(folder_ / "f/still_000003.png", name);
  }
};

TEST_F(NumberedFrames, AreFoundWhereTheyBelong) {
  fs::create_directories(folder_ / "long_000001_010,000");
  for (const char* file :
       {"long_000001_010,000/long_000007.png", "long_000001_010,000/long_000003.png", "long_000004.png",
        "long_000001_010,000/long_000005.exr", "long_000001_010,000/longer_000006.png"}) {
    write(file, "");
  }
  const auto path_of = [&](int frame) { return folder_ / frame_path("long", frame, 20'000, FramePart::whole, "png"); };
  EXPECT_THAT(numbered_frames(folder_, "long", path_of), ElementsAre(2, 6));
}

TEST_F(NumberedFrames, AreToldInRanges) {
  EXPECT_EQ(frame_ranges({3, 4, 5, 8, 10, 11}), "4:6, 9, 11:12");
  EXPECT_EQ(frame_ranges({0, 2, 4, 6, 8, 10, 12, 14, 16}), "1, 3, 5, 7, 9, 11, 13, 15, ...");
}

TEST_F(NumberedFrames, ThatWereAskedForOtherwiseAreTold) {
  ASSERT_EQ(render(""), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("otherwise")));
  ASSERT_EQ(render("--frames 1:3"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("otherwise")));
  ASSERT_EQ(render("--frames 1:3 --size 24"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("\nthe folder also contains 3 frames rendered with other options (4:6)\n"));
}

TEST_F(NumberedFrames, BeyondTheShowsEndAreTold) {
  ASSERT_EQ(render(""), 0) << output_;
  std::string shorter = numbered_show;
  write("still.toml", shorter.replace(shorter.find("0.6"), 3, "0.5"));
  ASSERT_EQ(render("--resume"), 0) << output_;
  EXPECT_THAT(
      output_,
      StartsWith(
          "0 frames in f; skipped 5 frames from an earlier run\nthe folder also contains 1 frame rendered with "));
}

TEST_F(NumberedFrames, ThatAreMadeAgainAreToldApartFromThoseThatWereMissing) {
  ASSERT_EQ(render("--frames 1:3"), 0) << output_;
  fs::remove(folder_ / "f/still_000002.png");
  ASSERT_EQ(render("--frames 1:4 --size 24 --resume"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("\n4 frames in f (2 replaced, rendered with other options before)\n"));
}

TEST_F(NumberedFrames, HaveTheirSheetWhenTheirRunIsStopped) {
  std::string longer = numbered_show;
  write("still.toml", longer.replace(longer.find("0.6"), 3, "900"));
  const std::string command = "cd '" + folder_.string() +
                              "' && { '" ERGODOME_PROGRAM
                              "' render still.toml --out f --backend cpu --lens direct & } 2> said; "
                              "until [ -e f/still_000002.png ]; do kill -0 $! || exit 9; sleep 0.02; done; "
                              "kill -TERM $!; wait $!";
  ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
  EXPECT_THAT(text("said"), HasSubstr("continue with --resume"));
  int there = 0;
  while (fs::exists(folder_ / "f" / frame_path("still", there, 9000, FramePart::whole, "png"))) {
    ++there;
  }
  EXPECT_EQ(nlohmann::json::parse(text("f/still.json"))["last_frame"], there);
}

TEST_F(NumberedFrames, SayWhereTheyAreAndHowTheyAreShown) {
  ASSERT_EQ(render("--frames 3"), 0) << output_;
  EXPECT_EQ(entry("frame"), "3");
  EXPECT_EQ(entry("time_s"), "0.200000");
  EXPECT_NEAR(std::stod(entry("exposure_stops")), -2.0, 1e-9);
  EXPECT_EQ(entry("tone_curve"), "reinhard");
  EXPECT_EQ(entry("tone_white"), "3");
  EXPECT_EQ(entry("fov_deg"), "180");
  EXPECT_EQ(entry("tilt_deg"), "20");
}

TEST_F(NumberedFrames, SayWhichWayTheCameraLooks) {
  ASSERT_EQ(render("--frames 3"), 0) << output_;
  EXPECT_GT(std::stod(entry("phi_deg")), 350.0);
  std::istringstream forward(entry("forward"));
  double r = 0.0;
  double theta = 0.0;
  double phi = 0.0;
  forward >> r >> theta >> phi;
  // The view direction is a quarter turn to the right of the hole, so it is e_φ.
  EXPECT_NEAR(r, 0.0, 1e-9);
  EXPECT_NEAR(theta, 0.0, 1e-9);
  EXPECT_NEAR(phi, 1.0, 1e-9);
}

}  // namespace
}  // namespace ergodome
