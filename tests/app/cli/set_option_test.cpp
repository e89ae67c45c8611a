#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

//! Tests --set, which overrides keys of a show, in all commands that have it.
class SetOption : public test::CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("small.toml",
          "title = { en = \"Evening\", de = \"Abend\" }\nduration_s = 0.1\nframe_rate_hz = 20\n[hole]\nspin = 0.9\n"
          "[[camera.key]]\nr = 8\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 32\n");
  }
};

TEST_F(SetOption, ChangesWhatCommandsRead) {
  ASSERT_EQ(run("inspect small.toml --json --set hole.spin=0.5 --set camera.key.0.r=30"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("\"spin\": 0.5"), HasSubstr("\"r\": 30.0"), HasSubstr("\"de\": \"Abend\"")));
  ASSERT_EQ(run("plan --set view.size_px=48 small.toml"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("48 x 48 pixels"), HasSubstr("Evening")));
  ASSERT_EQ(run("inspect small.toml --set tone.gamma=2"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("--set  tone.gamma"));
}

TEST_F(SetOption, IsAnErrorOfTheCommandLine) {
  EXPECT_EQ(run("inspect small.toml --set hole.spinn=0.5"), 2);
  EXPECT_THAT(output_, AllOf(HasSubstr("--set hole.spinn"), HasSubstr("did you mean \"hole.spin\"")));
  EXPECT_EQ(run("render small.toml --set hole.spin=0.5 --set sky.map=missing.png --out frames"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("missing.png"), HasSubstr("(sky.map, --set)")));
  EXPECT_EQ(run("inspect sky.ppm --set hole.spin=0.5"), 2) << output_;
  EXPECT_THAT(output_, HasSubstr("has no effect for a sky map"));
}

TEST_F(SetOption, IsNoticedByResume) {
  ASSERT_EQ(run("render small.toml --out frames"), 0) << output_;
  ASSERT_EQ(run("render small.toml --out frames --resume"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("0 frames"), HasSubstr("skipped 2 frames")));
  ASSERT_EQ(run("render small.toml --out frames --resume --set hole.spin=0.5"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("2 replaced"));
  ASSERT_EQ(run("render small.toml --out frames --resume --set hole.spin=0.5"), 0) << output_;
  EXPECT_THAT(output_, AllOf(HasSubstr("0 frames"), Not(HasSubstr("again"))));
}

TEST_F(SetOption, LanguageChoosesTheTitleThatFilesHold) {
  ASSERT_EQ(run("render small.toml --out frames --frames 1 --language de"), 0) << output_;
  EXPECT_THAT(text("frames/small.txt"), HasSubstr("title: Abend"));
  ASSERT_EQ(run("render small.toml --out frames --frames 1 --set title.en=Night"), 0) << output_;
  EXPECT_THAT(text("frames/small.txt"), HasSubstr("title: Night"));
}

}  // namespace
}  // namespace ergodome
