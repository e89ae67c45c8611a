#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/app/cli/command_line.h"

// Compares films that are rendered in chunks, in any order, with films of a single run.
namespace ergodome::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* split_camera =
    "duration_s = 0.8\nframe_rate_hz = 10\n[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nt_s = 0\nr = 30\n"
    "[[camera.key]]\nt_s = 0.8\nr = 8\nyaw_deg = 90\n[view]\nsize_px = 48\n[sky]\nmap = \"sky.ppm\"\n";
constexpr const char* automatic_exposure =
    "[tone]\nauto = { target = 0.18, adapt_s = 0.5, least_stops = -6, most_stops = 6 }\n";

class SplitFilms : public CommandLine {
 protected:
  //! Renders the show in one run and by a farm in tasks of three frames, and compares the frames.
  void expect_same_film(const std::string& show, const std::string& options = "") {
    write("film.toml", show);
    ASSERT_EQ(run("render film.toml --backend cpu --out whole " + options), 0) << output_;
    ASSERT_EQ(
        run("farm film.toml --backend cpu --out split --chunk 3 --bake 0 --jobs 3 --program '" ERGODOME_CALL_PROGRAM
            "' " +
            options),
        0)
        << output_;
    expect_frames();
  }

  void expect_frames() const {
    int compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "whole")) {
      const std::string name = fs::relative(entry.path(), folder_ / "whole").string();
      if (entry.is_regular_file()) {
        EXPECT_TRUE(text("whole/" + name) == text("split/" + name)) << name;
        ++compared;
      }
    }
    EXPECT_GE(compared, 5);
  }
};

TEST_F(SplitFilms, HaveTheAutomaticExposureOfOneRun) {
  expect_same_film(std::string(split_camera) + automatic_exposure);
  EXPECT_THAT(output_, HasSubstr("light: 3 tasks done"));
}

TEST_F(SplitFilms, HaveTheAutomaticExposureOfOneRunWithAnimatedSettings) {
  expect_same_film(std::string(split_camera) + automatic_exposure +
                   "[[animate]]\nnumber = \"tone.auto.target\"\n[[animate.key]]\nt_s = 0\nvalue = 0.1\n"
                   "[[animate.key]]\nt_s = 0.8\nvalue = 0.4\n");
}

TEST_F(SplitFilms, HaveTheAutomaticExposureOfOneRunAfterARepair) {
  expect_same_film(std::string(split_camera) + automatic_exposure);
  for (const char* frame : {"split/film_000001.png", "split/film_000004.png", "split/film_000005.png"}) {
    fs::remove(folder_ / frame);
  }
  ASSERT_EQ(run("farm film.toml --backend cpu --out split --chunk 3 --bake 0 --program '" ERGODOME_CALL_PROGRAM "'"), 0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("render: 2 tasks done"));
  expect_frames();
}

TEST_F(SplitFilms, HaveTheStarsAndTrailsOfOneRun) {
  expect_same_film(std::string(split_camera) +
                       "stars = \"bright_stars\"\n[effects]\npsf = { sigma_px = 0.7 }\nbloom = { strength = 0.2 }\n"
                       "redshift = true\nmagnification = true\ntrails = { shutter_s = 0.3 }\n",
                   "--frames 2:6 --size 24");
}

TEST_F(SplitFilms, HaveTheDiskAndBothEyesOfOneRun) {
  expect_same_film(std::string(split_camera) + "[disk]\n[stereo]\nlayout = \"separate\"\nbaseline = 0.1\n");
}

TEST_F(SplitFilms, HaveTheSettingsThatABudgetChoseOnce) {
  write("film.toml", split_camera);
  ASSERT_EQ(
      run("farm film.toml --backend cpu --out split --chunk 3 --budget 1px,30fps --program '" ERGODOME_CALL_PROGRAM
          "'"),
      0)
      << output_;
  // The settings are an option of every task; a second run takes them from the first.
  const std::string script = text("split/farm/runs/0001/render.sh");
  const std::size_t begin = script.find("--set=quality.budget_px=");
  ASSERT_NE(begin, std::string::npos) << script;
  const std::string settings = script.substr(begin, script.find(" --resume") - begin);
  ASSERT_EQ(run("render film.toml --backend cpu --out whole " + settings), 0) << output_;
  expect_frames();
  ASSERT_EQ(
      run("farm film.toml --backend cpu --out split --chunk 3 --budget 1px,30fps --program '" ERGODOME_CALL_PROGRAM
          "'"),
      0)
      << output_;
  EXPECT_THAT(output_, testing::Not(HasSubstr("render:")));
}

TEST_F(SplitFilms, AreFollowedOnlyIfTheExposureIsAutomatic) {
  write("film.toml", split_camera);
  EXPECT_EQ(run("render film.toml --backend cpu --meter light"), 2);
  EXPECT_THAT(output_, HasSubstr("--meter light: has no effect: the exposure of these frames is not automatic"));
  write("film.toml", std::string(split_camera) + automatic_exposure);
  EXPECT_EQ(run("render film.toml --backend cpu --light nowhere"), 1);
  EXPECT_THAT(output_, HasSubstr("--light nowhere: cannot be read"));
  ASSERT_EQ(run("render film.toml --backend cpu --meter light --frames 1:2"), 0) << output_;
  EXPECT_FALSE(fs::exists(folder_ / "frames"));
  write("light/light-000003-000003", "3 0123 bright\n");
  EXPECT_EQ(run("render film.toml --backend cpu --light light --frames 1:2"), 1);
  EXPECT_THAT(output_, HasSubstr("light-000003-000003:1: is not the light of a frame; remove the file"));
}

TEST_F(SplitFilms, AreVerified) {
  write("film.toml", split_camera);
  ASSERT_EQ(run("render film.toml --backend cpu --out split --no-summary"), 0) << output_;
  EXPECT_FALSE(fs::exists(folder_ / "split/film.json"));
  ASSERT_EQ(run("render film.toml --backend cpu --out split --verify"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("8 frames in split verified"));
  EXPECT_TRUE(fs::exists(folder_ / "split/film.json"));
  fs::remove(folder_ / "split/film_000003.png");
  write("split/film_000008.png", text("split/film_000008.png").substr(0, 200));
  EXPECT_EQ(run("render film.toml --backend cpu --out split --verify"), 1);
  EXPECT_THAT(output_, HasSubstr("split: 2 frames are missing, damaged or rendered with other options (3, 8); render "
                                 "them with --resume"));
  EXPECT_FALSE(fs::exists(folder_ / "split/film_000003.png"));
}

}  // namespace
}  // namespace ergodome::test
