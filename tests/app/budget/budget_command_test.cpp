#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* budget_show =
    "duration_s = 4\n[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 12\ntheta_deg = 80\n[[camera.key]]\nt_s = 4\nr "
    "= 6\n"
    "theta_deg = 90\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 64\n";

TEST_F(CommandLine, RenderSaysWhatABudgetChoseAndCost) {
  write("small.toml", budget_show);
  ASSERT_EQ(run("render small.toml --budget 0.5px --backend cpu --lens live --frames 1:2 --out f"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("budget 0.5px: live lens at "));
  EXPECT_THAT(output_, HasSubstr("measured error "));
  EXPECT_THAT(output_, HasSubstr(" ms per frame"));
  EXPECT_THAT(output_, HasSubstr("measuring took "));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "f" / "small_000002.png"));
}

TEST_F(CommandLine, RenderChecksABudgetAtRandomMomentsAndWritesNothing) {
  write("small.toml", budget_show);
  ASSERT_EQ(run("render small.toml --budget 0.5px --backend cpu --check 3 --out f"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("error at 3 random moments: median "));
  EXPECT_THAT(output_, HasSubstr("within the budget of 0.5 px"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f"));
}

TEST_F(CommandLine, RenderSaysHowMuchOfARateIsMissed) {
  write("small.toml", budget_show);
  ASSERT_EQ(run("render small.toml --size 512 --budget 1000fps,0.5px --backend cpu --frames 1:1 --out f"), 0)
      << output_;
  // If the machine is extremely slow, the time for measuring ends before any frame time is known.
  EXPECT_THAT(output_,
              AnyOf(HasSubstr("the frame rate is missed: a frame takes "), HasSubstr("frame time not measured")));
  EXPECT_THAT(output_, Not(HasSubstr("exceeds the error budget")));
}

TEST_F(CommandLine, BudgetsThatAreNoneEndWithARemedy) {
  write("small.toml", budget_show);
  EXPECT_NE(run("render small.toml --budget 60 --backend cpu"), 0);
  EXPECT_THAT(output_,
              HasSubstr("ergodome: --budget 60: is neither an error in px nor a frame rate in fps; write, for"));
  EXPECT_NE(run("render small.toml --check 3 --backend cpu"), 0);
  EXPECT_THAT(output_, HasSubstr("--check: needs an error budget to check; add one, for example"));
}

TEST_F(CommandLine, PlayHoldsABudgetAndTellsWhatBecameOfIt) {
  if (!has_display()) {
    GTEST_SKIP() << "no virtual display here (xvfb-run)";
  }
  write("small.toml", budget_show);
  ASSERT_EQ(run_on_display("play small.toml --budget 1px --budget 5fps --size 64 --backend cpu --no-sound --for 2", ""),
            0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("budget 1px,5fps: lens at "));
  EXPECT_THAT(output_, HasSubstr(" % from the target), "));
  EXPECT_THAT(output_, HasSubstr("settings changed "));
}

TEST_F(CommandLine, PlayForNoSecondsEndsAfterItsFirstPicture) {
  if (!has_display()) {
    GTEST_SKIP() << "no virtual display here (xvfb-run)";
  }
  write("small.toml", budget_show);
  ASSERT_EQ(run_on_display("play small.toml --size 64 --backend cpu --no-sound --for 0", ""), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(" s, not counting the first\n"));
}

}  // namespace
}  // namespace ergodome
