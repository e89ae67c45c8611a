#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/output/image_reader.h"
#include "tests/app/cli/command_line.h"

namespace ergodome::test {
namespace {

using testing::HasSubstr;
using testing::Not;

//! Renders a show whose camera flies into bright light, with automatic exposure.
class FollowedExposure : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("fall.toml",
          "duration_s = 0.8\nframe_rate_hz = 10\n[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nt_s = 0\nr = 30\n"
          "[[camera.key]]\nt_s = 0.8\nr = 4\nyaw_deg = 90\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 32\n"
          "[tone]\nauto = { target = 0.18, adapt_s = 0.5, least_stops = -6, most_stops = 6 }\n");
    EXPECT_EQ(run("render fall.toml --backend cpu --out whole"), 0) << output_;
    EXPECT_THAT(output_, Not(HasSubstr("starts again")));
  }

  [[nodiscard]] std::vector<std::uint16_t> frame(const std::string& folder, int number) const {
    return read_display_pixels(folder_ / folder / ("fall_00000" + std::to_string(number) + ".png")).values;
  }

  void expect_whole(const std::string& folder) const {
    for (int number = 1; number <= 8; ++number) {
      EXPECT_EQ(frame(folder, number), frame("whole", number)) << number;
    }
  }
};

TEST_F(FollowedExposure, OfFramesThatAreResumedIsThatOfTheWhole) {
  std::filesystem::copy(folder_ / "whole", folder_ / "torn");
  for (const char* frame : {"torn/fall_000003.png", "torn/fall_000004.png", "torn/fall_000007.png"}) {
    std::filesystem::remove(folder_ / frame);
  }
  EXPECT_EQ(run("render fall.toml --backend cpu --out torn --resume"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("starts again")));
  expect_whole("torn");
}

TEST_F(FollowedExposure, OfPartsInOneFolderIsThatOfTheWhole) {
  EXPECT_EQ(run("render fall.toml --backend cpu --out parts --frames 1:3"), 0) << output_;
  EXPECT_EQ(run("render fall.toml --backend cpu --out parts --frames 4:8"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("starts again")));
  expect_whole("parts");
}

TEST_F(FollowedExposure, OfPartsThatBeganAnewIsMadeAgainWhereTheFramesBeforeHaveCome) {
  EXPECT_EQ(run("render fall.toml --backend cpu --out later --frames 5:8"), 0) << output_;
  EXPECT_EQ(run("render fall.toml --backend cpu --out later --frames 1:4"), 0) << output_;
  EXPECT_EQ(run("render fall.toml --backend cpu --out later --resume"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("4 frames in later; skipped 4 frames from an earlier run"));
  expect_whole("later");
}

TEST_F(FollowedExposure, ThatBeginsAnewIsTold) {
  EXPECT_EQ(run("render fall.toml --backend cpu --out middle --frames 5:6"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("starts again at frame 5"));
  EXPECT_NE(frame("middle", 5), frame("whole", 5));
}

TEST_F(FollowedExposure, DoesNotGoOnFromFramesThatWereAskedForOtherwise) {
  EXPECT_EQ(run("render fall.toml --backend cpu --out mixed --frames 1:3 --lens direct"), 0) << output_;
  EXPECT_EQ(run("render fall.toml --backend cpu --out mixed --frames 4:5 --lens live"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("starts again at frame 4"));
}

TEST_F(FollowedExposure, SaysNothingOfLightThatNoExposureChanges) {
  EXPECT_EQ(run("render fall.toml --backend cpu --out light --frames 5:6 --format exr"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("starts again")));
}

}  // namespace
}  // namespace ergodome::test
