#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <map>
#include <string>

#include "app/commands/farm/programs.h"
#include "tests/app/cli/command_line.h"

// A machine that is believed to have failed may finish its work while another repeats it.
namespace ergodome::test {
namespace {

namespace fs = std::filesystem;

class TwoWriters : public CommandLine {
 protected:
  //! Runs a command in several processes at the same time. Returns the number of those that failed.
  int run_at_once(const std::string& arguments, int processes) {
    std::vector<pid_t> running;
    running.reserve(static_cast<std::size_t>(processes));
    for (int i = 0; i < processes; ++i) {
      running.push_back(
          start_program({"bash", "-c", "cd '" + folder_.string() + "' && exec '" ERGODOME_PROGRAM "' " + arguments}));
    }
    int failed = 0;
    for (const pid_t process : running) {
      int status = 0;
      ::waitpid(process, &status, 0);
      failed += exit_status(status) != 0 ? 1 : 0;
    }
    return failed;
  }

  //! Returns the contents of all files in a folder.
  [[nodiscard]] std::map<std::string, std::string> files_of(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
      const std::string name = entry.path().filename().string();
      files[name] = text((fs::path(folder) / name).string());
    }
    return files;
  }
};

TEST_F(TwoWriters, OfTheSameFramesLeaveTheFramesOfOne) {
  write("film.toml",
        "duration_s = 2\nframe_rate_hz = 10\n[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nr = 20\n"
        "[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 32\n");
  ASSERT_EQ(run("render film.toml --backend cpu --out one"), 0) << output_;
  EXPECT_EQ(run_at_once("render film.toml --backend cpu --out both", 3), 0);
  EXPECT_TRUE(files_of("one") == files_of("both"));
}

TEST_F(TwoWriters, OfTheSamePartOfABakeLeaveTheTrajectoryOfOne) {
  write("film.toml",
        "duration_s = 2\n[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nt_s = 0\nr = 20\n[[camera.key]]\nt_s = 2\n"
        "r = 12\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 64\n");
  ASSERT_EQ(run("bake film.toml --out one.trajectory"), 0) << output_;
  EXPECT_EQ(run_at_once("bake film.toml --out both.trajectory --part 1/2", 3), 0);
  EXPECT_EQ(run_at_once("bake film.toml --out both.trajectory --part 2/2", 2), 0);
  ASSERT_EQ(run("bake film.toml --out both.trajectory"), 0) << output_;
  EXPECT_THAT(output_, testing::HasSubstr("(0 computed now)"));
  EXPECT_TRUE(text("one.trajectory") == text("both.trajectory"));
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
}

}  // namespace
}  // namespace ergodome::test
