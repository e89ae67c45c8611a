#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "app/cli/lens_options.h"
#include "app/cli/show_loading.h"
#include "content/trajectory/trajectory_journal.h"
#include "content/trajectory/trajectory_reader.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"
#include "tests/support/sanitized.h"

// Tests of `ergodome bake`, and of how other commands use the trajectory file that it writes.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::CommandLine;
using testing::HasSubstr;

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
map = "sky.ppm"
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

  //! Starts the program without waiting for it to end.
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
  EXPECT_THAT(output_, HasSubstr("is already baked"));
  ASSERT_EQ(run("inspect moving.trajectory --picture grid.png --size 64 --time 5"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("gap error [px]"));
  EXPECT_EQ(run("inspect moving.trajectory --picture none.png --size 64 --time 11"), 2);
  EXPECT_THAT(output_, HasSubstr("11 s is outside moving.trajectory; choose from 0 to 10 s"));
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
      EXPECT_TRUE(text("killed.trajectory") == text("whole.trajectory"));
      fs::remove(folder_ / "killed.trajectory");
    }
  }
  EXPECT_EQ(killed, wanted);
  ASSERT_EQ(run("bake moving.toml --out killed.trajectory --no-derivatives --budget 0.05"), 0) << output_;
  EXPECT_TRUE(text("killed.trajectory") == text("whole.trajectory"));
  // The killed runs have left no temporary files.
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_TRUE(entry.path().extension() == ".trajectory" || entry.path().extension() == ".toml" ||
                entry.path().extension() == ".ppm")
        << entry.path();
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
  EXPECT_THAT(output_, HasSubstr("(0 computed now)"));
  EXPECT_TRUE(text("joined.trajectory") == text("whole.trajectory"));
  EXPECT_FALSE(fs::exists(folder_ / "joined.trajectory.part-1-of-3"));
}

//! A file that another process uses, as a machine does that is believed to have failed.
class FileInUse {
 public:
  explicit FileInUse(const fs::path& file) : handle_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    EXPECT_EQ(::flock(handle_, LOCK_EX | LOCK_NB), 0);
  }
  ~FileInUse() { ::close(handle_); }
  FileInUse(const FileInUse&) = delete;
  FileInUse& operator=(const FileInUse&) = delete;

 private:
  int handle_;
};

TEST_F(BakeCommand, PartsInUseAreBakedAgainBesideThemAndJoinToTheSameFile) {
  write("short.toml",
        std::string(moving_show).replace(std::string(moving_show).find("size_px = 512"), 13, "size_px = 64"));
  ASSERT_EQ(run("bake short.toml --out whole.trajectory"), 0) << output_;
  {
    const FileInUse first(folder_ / "joined.trajectory.part-1-of-2");
    ASSERT_EQ(run("bake short.toml --out joined.trajectory --part 1/2"), 0) << output_;
    EXPECT_THAT(output_,
                HasSubstr("joined.trajectory.part-1-of-2 is in use by another process; this part is baked to"));
    const FileInUse second(folder_ / "joined.trajectory.part-2-of-2");
    ASSERT_EQ(run("bake short.toml --out joined.trajectory"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("joined.trajectory.part-2-of-2 is still in use"));
  }
  EXPECT_TRUE(text("joined.trajectory") == text("whole.trajectory"));
  ASSERT_EQ(run("bake short.toml --out joined.trajectory --part 2/2"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("is already baked"));
}

TEST_F(BakeCommand, RenderStreamsFromTheFileBesideTheShowAndSkipsABadStation) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for minutes";
  }
  ASSERT_EQ(run("bake moving.toml --out moving.trajectory"), 0) << output_;
  ASSERT_EQ(run("render moving.toml --size 64 --frames 100:101 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("streamed: 4 lenses"));
  EXPECT_THAT(output_, testing::Not(HasSubstr("too coarse")));
  ASSERT_EQ(run("plan moving.toml --size 4096"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("is too coarse for 0.25 px at 4096: lenses are computed live instead"));
  EXPECT_THAT(output_, HasSubstr("bake it again with --size 4096\n"));
  EXPECT_THAT(output_, HasSubstr("lens: live"));
  write("finer.toml", text("moving.toml") + "[quality]\nbudget_px = 0.0123456\n");
  ASSERT_EQ(run("plan finer.toml --size 64 --trajectory moving.trajectory"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("is too coarse for 0.0123 px at 64"));
  EXPECT_THAT(output_, HasSubstr("bake it again with --size 64 --budget 0.0123\n"));
  std::string bytes = text("moving.trajectory");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 16);
  write("moving.trajectory", bytes);
  EXPECT_NE(run("inspect moving.trajectory"), 0);
  EXPECT_THAT(output_, HasSubstr(": station "));
  ASSERT_EQ(run("render moving.toml --size 64 --frames 150:155 --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("(skipped)"));
  EXPECT_EQ(output_.find("(skipped)"), output_.rfind("(skipped)"));
  EXPECT_THAT(output_, HasSubstr("1 damaged"));
}

constexpr const char* still_show =
    "[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nr = 12\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 32\n";

TEST_F(BakeCommand, DoesNotReplaceAnotherShowsTrajectoryUnlessAsked) {
  write("still.toml", still_show);
  write("faster.toml", std::string(still_show).replace(13, 3, "0.6"));
  ASSERT_EQ(run("bake still.toml --out baked --no-derivatives"), 0) << output_;
  const std::string before = text("baked");
  EXPECT_NE(run("bake faster.toml --out baked"), 0);
  EXPECT_THAT(output_,
              HasSubstr("--out baked: already exists and does not belong to this show: was baked for another spin"));
  EXPECT_THAT(output_, HasSubstr("--replace"));
  EXPECT_TRUE(text("baked") == before);
  ASSERT_EQ(run("bake faster.toml --out baked --replace --no-derivatives"), 0) << output_;
  EXPECT_FALSE(text("baked") == before);
}

TEST_F(BakeCommand, DoesNotReplaceAFileThatIsNoTrajectory) {
  write("still.toml", still_show);
  write("notes.txt", "of the day");
  EXPECT_NE(run("bake still.toml --out notes.txt"), 0);
  EXPECT_THAT(output_, HasSubstr("already exists and is not a trajectory"));
  EXPECT_EQ(text("notes.txt"), "of the day");
}

TEST_F(BakeCommand, ReplacesItsOwnShowsTrajectoryOfOtherSettings) {
  write("still.toml", still_show);
  ASSERT_EQ(run("bake still.toml --out baked --no-derivatives"), 0) << output_;
  EXPECT_EQ(run("bake still.toml --out baked --budget 0.1 --no-derivatives"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("computed now"));
}

//! Copies a trajectory file, but marks gaps (between adjacent stations) as missing the error budget
//! by far.
void write_missed_gaps(const fs::path& baked, const fs::path& missed) {
  const TrajectoryReader reader(baked);
  TrajectoryJournal journal(missed.string() + ".part", reader.provenance());
  std::vector<double> times_s;
  for (std::size_t i = 0; i < reader.stations().size(); ++i) {
    const StationEntry& station = reader.stations()[i];
    journal.add(station.time_s, reader.read(i));
    if (i > 0) {
      journal.add(Gap{times_s.back(), station.time_s, 6.0F, 0.0F});
    }
    times_s.push_back(station.time_s);
  }
  journal.seal(missed, times_s);
}

TEST_F(BakeCommand, StreamsTellWhatATrajectoryMisses) {
  std::string small = moving_show;
  small.replace(small.find("size_px = 512"), 13, "size_px = 32");
  write("small.toml", small + "[quality]\nbudget_px = 4\n");
  ASSERT_EQ(run("bake small.toml --out good --no-derivatives"), 0) << output_;
  write_missed_gaps(folder_ / "good", folder_ / "bad");
  const Show show = load_show((folder_ / "small.toml").string());
  LensOptions options;
  const auto notes = [&](const char* trajectory, int size_px) {
    options.trajectory = (folder_ / trajectory).string();
    return stream_notes(open_stream(show, options, Backend::cpu).get(), show, options, Backend::cpu, size_px);
  };
  EXPECT_THAT(notes("good", 0), testing::IsEmpty());
  const TrajectoryReader bad(folder_ / "bad");
  const double middle_s = 0.5 * (bad.stations()[0].time_s + bad.stations()[1].time_s);
  EXPECT_THAT(
      notes("bad", 0),
      testing::ElementsAre(testing::AllOf(
          HasSubstr("bad exceeds the budget of 4 px in "),
          HasSubstr(fmt::format(
              "10 s of the show); the largest error is 6.000 px at {:.2f} s; frames there use live grids", middle_s)))))
      << "as the bake tells it";
  EXPECT_THAT(notes("bad", 16), testing::IsEmpty()) << "half as many pixels";
  Show turning = show;
  turning.stereo = {StereoLayout::separate, StereoModel::omni, 0.1};
  EXPECT_THAT(stream_notes(open_stream(turning, options, Backend::cpu).get(), turning, options, Backend::cpu, 2048),
              testing::ElementsAre(HasSubstr("stereo model omni")));
  EXPECT_THAT(notes("good", 2048), testing::ElementsAre(HasSubstr((folder_ / "good").string() +
                                                                  " was baked for 4 px in frames 32 px wide")));
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
  EXPECT_THAT(output_, HasSubstr("(trajectory ignored)"));
  EXPECT_NE(run("render moving.toml --size 16 --frames 1 --lens streamed"), 0);
  EXPECT_THAT(output_, HasSubstr("needs a trajectory"));
  EXPECT_NE(run("render moving.toml --size 16 --frames 1 --trajectory moving.toml"), 0);
  EXPECT_THAT(output_, HasSubstr("is not a trajectory"));
  EXPECT_NE(run("bake moving.toml --out /dev/null/x"), 0);
  EXPECT_NE(run("bake moving.toml --out m --part 3/2"), 0);
  EXPECT_THAT(output_, HasSubstr("does not name a part"));
  EXPECT_NE(run("bake moving.toml --out m --budget 0"), 0);
  write("quadtree.toml", std::string(moving_show) + "[grid]\nscheme = \"quadtree\"\n");
  EXPECT_NE(run("bake quadtree.toml --out q"), 0);
  EXPECT_THAT(output_, HasSubstr("cannot be baked"));
  write("half.part", "title");
  EXPECT_NE(run("bake moving.toml --out half"), 0);
}

}  // namespace
}  // namespace ergodome
