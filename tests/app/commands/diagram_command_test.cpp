#include <gmock/gmock.h>

#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"

namespace ergodome::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* ball_show =
    "title = \"A ball\"\nduration_s = 2\nframe_rate_hz = 1\n[hole]\nspin = 0\n[camera]\n[[camera.key]]\nt_s = 0\nr = "
    "30\n"
    "theta_deg = 90\nphi_deg = 0\n[[objects]]\nshape = \"sphere\"\nposition = [-6, 4, 0]\n[sky]\nmap = \"sky.ppm\"\n";

class DiagramCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("ball.toml", ball_show);
  }

  //! Returns the error message for invalid options.
  std::string refusal(const std::string& words) {
    EXPECT_NE(run("diagram " + words), 0) << words;
    return output_;
  }

  //! Returns false if a command failed because OpenGL is not available.
  bool draws(int status) const { return status == 0 || output_.find("OpenGL") == std::string::npos; }
};

TEST_F(DiagramCommand, WritesAPictureOfTheSizeThatIsAskedForAndSaysWhatIsInIt) {
  const int status =
      run_with_driver("diagram ball.toml --out ball.png --size 320x200 --rays 6 --at 1 --from -60,20,90");
  if (!draws(status)) {
    GTEST_SKIP() << output_;
  }
  ASSERT_EQ(status, 0) << output_;
  EXPECT_TRUE(is_complete_image(folder_ / "ball.png", 320, 200));
  EXPECT_THAT(output_, HasSubstr("6 light rays"));
  EXPECT_THAT(output_, HasSubstr("image 2"));
}

TEST_F(DiagramCommand, WritesAPictureForEachFrame) {
  const int status = run_with_driver("diagram ball.toml --out frames --frames 1:2 --size 160");
  if (!draws(status)) {
    GTEST_SKIP() << output_;
  }
  ASSERT_EQ(status, 0) << output_;
  for (const char* name : {"ball_diagram_000001.png", "ball_diagram_000002.png"}) {
    EXPECT_TRUE(is_complete_image(folder_ / "frames" / name, 160, 90)) << name;
  }
}

TEST_F(DiagramCommand, RefusesShowsThatHaveNothingToDraw) {
  EXPECT_THAT(refusal("first-light --out x.png"), HasSubstr("has no objects"));
  EXPECT_THAT(refusal("nothing --out x.png"), HasSubstr("neither a file nor a built-in show"));
}

TEST_F(DiagramCommand, RefusesImageOrdersOfAHoleThatSpins) {
  EXPECT_THAT(refusal("planet --images 1,2 --out x.png"), HasSubstr("--images: planet has a spinning hole"));
}

TEST_F(DiagramCommand, RefusesTimesOutsideTheShow) {
  for (const char* time : {"3", "-1", "nan"}) {
    EXPECT_THAT(refusal(std::string("ball.toml --out x.png --at ") + time), HasSubstr("choose from 0 to 2 s")) << time;
  }
}

TEST_F(DiagramCommand, RefusesAFolderThatIsNotThere) {
  const std::string problem = refusal("ball.toml --out nowhere/x.png --size 64x64");
  EXPECT_THAT(problem, HasSubstr("nowhere"));
}

TEST_F(DiagramCommand, RefusesOptionsThatMakeNoSense) {
  EXPECT_THAT(refusal("ball.toml --out x.jpg"), HasSubstr("does not end in .png"));
  for (const char* size : {"10", "100x", "axb", "1e9", "100x100x100", "100.5"}) {
    EXPECT_THAT(refusal(std::string("ball.toml --out x.png --size ") + size), HasSubstr("is not a picture size"))
        << size;
  }
  for (const char* images : {"0", "6", "1.5", "one", "1,,2"}) {
    EXPECT_THAT(refusal(std::string("ball.toml --out x.png --images ") + images),
                HasSubstr("is not a list of image orders"))
        << images;
  }
  for (const char* from : {"10", "10,95", "10,20,0", "10,20,30,40", "north"}) {
    EXPECT_THAT(refusal(std::string("ball.toml --out x.png --from ") + from), HasSubstr("is not a camera position"))
        << from;
  }
  EXPECT_THAT(refusal("ball.toml --out x --frames 1:2 --at 1"), HasSubstr("--at"));
  EXPECT_THAT(refusal("ball.toml --out x --frames 7"), HasSubstr("choose from 1:"));
}

}  // namespace
}  // namespace ergodome::test
