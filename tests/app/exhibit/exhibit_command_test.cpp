#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <thread>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::HasSubstr;

//! Runs an exhibit on a virtual display. The visitor is simulated by the recording of a gamepad.
class ExhibitInAWindow : public test::CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (!has_display()) {
      GTEST_SKIP() << "no virtual display here (xvfb-run)";
    }
    write("attract.toml", "duration_s = 10\n" + scene_);
    write("visitor.toml", scene_);
  }

  int exhibit(const std::string& options) {
    return run_on_display(
        "play visitor.toml --exhibit --attract " + attract_ + " --no-sound --backend cpu --size 64 " + options,
        "XDG_STATE_HOME='" + folder_.string() + "/state' XDG_CONFIG_HOME='" + folder_.string() + "'");
  }

  [[nodiscard]] std::string log() const { return text("state/ergodome/ergodome.log"); }

  std::string attract_ = "attract.toml";
  std::string scene_ =
      "[hole]\nspin = 0.5\n[camera]\n[[camera.key]]\nr = 12\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 64\n";
};

TEST_F(ExhibitInAWindow, LetsAVisitorFlyWhoTakesThePad) {
  ASSERT_EQ(exhibit("--record flight.toml --for 6 --pad-fixture '" ERGODOME_TEST_DATA_DIR "/hid/flight.toml'"), 0)
      << output_;
  EXPECT_THAT(log(), HasSubstr("a visitor arrived"));
  const Show flight = read_show(folder_ / "flight-000001.toml");
  EXPECT_GT(flight.duration_s, 1.0);
  const CameraPose first = camera_pose(flight, 0.0);
  const CameraPose last = camera_pose(flight, flight.duration_s);
  EXPECT_TRUE(std::abs(last.r - first.r) > 0.01 || std::abs(last.phi - first.phi) > 0.01);
}

TEST_F(ExhibitInAWindow, RecordsEachVisitAndNothingOfTheAttractShow) {
  write("flight-000001.toml", "of another run");
  const std::string flies = "--record flight.toml --pad-fixture '" ERGODOME_TEST_DATA_DIR "/hid/flight.toml' ";
  // The 6.5 s contain a visit, three seconds without input, another visit, and the attract show.
  ASSERT_EQ(exhibit(flies + "--session 1 --for 6.5"), 0) << output_;
  EXPECT_EQ(text("flight-000001.toml"), "of another run");
  // The number of visits depends on the speed of the machine, so it is read from the log.
  const std::string reported = log();
  const std::string visit = "a visitor arrived";
  int visits = 0;
  for (std::size_t at = reported.find(visit); at != std::string::npos; at = reported.find(visit, at + 1)) {
    ++visits;
  }
  ASSERT_GE(visits, 2);
  // The last visit may not have produced a flight yet.
  for (int number = 2; number <= visits; ++number) {
    EXPECT_LT(read_show(folder_ / fmt::format("flight-{:06}.toml", number)).duration_s, 3.0) << number;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / fmt::format("flight-{:06}.toml", 2 + visits)));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "flight.toml"));
}

TEST_F(ExhibitInAWindow, RefusesToShowWhatWouldBeRemovedAmongItsRecords) {
  write("flight-000001.toml", scene_);
  attract_ = "flight-000001.toml";
  EXPECT_EQ(exhibit("--record flight.toml"), 2);
  EXPECT_THAT(output_, HasSubstr("rename the show"));
}

TEST_F(ExhibitInAWindow, ShowsTheAttractShowWhenNobodyComes) {
  ASSERT_EQ(exhibit("--for 2 --screenshot shot.png"), 0) << output_;
  EXPECT_THAT(log(), testing::Not(HasSubstr("a visitor arrived")));
}

TEST_F(ExhibitInAWindow, NotesInItsLogThatAnAttractShowDoesNotFitTheScreen) {
  write("visitor.toml", scene_ + "projection = \"pinhole\"\n");
  ASSERT_EQ(exhibit("--for 0.2"), 0) << output_;
  EXPECT_THAT(log(), HasSubstr("attract: is not made for flat screens"));
}

TEST_F(ExhibitInAWindow, LogsThatATrajectoryIsTooCoarse) {
  ASSERT_EQ(run("bake attract.toml --out attract.trajectory --size 16 --no-derivatives"), 0) << output_;
  ASSERT_EQ(exhibit("--for 0.2"), 0) << output_;
  EXPECT_THAT(log(), HasSubstr("is too coarse for 0.25 px at 64: each pixel is traced instead"));
}

TEST_F(ExhibitInAWindow, LogsWhatBeginsAndWhyItEnds) {
  ASSERT_EQ(exhibit("--for 0.2 --web 0"), 0) << output_;
  EXPECT_THAT(log(), HasSubstr("exhibit started: ergodome " ERGODOME_VERSION
                               ", visitors' show visitor, attract show attract, cpu ("));
  EXPECT_THAT(log(), HasSubstr("), status page at 127.0.0.1:"));
  EXPECT_THAT(log(), HasSubstr("exhibit ended: the time limit of --for (0.2 s) was reached"));
}

TEST_F(ExhibitInAWindow, LogsThatTheVisitorsShowBreaksWhileTheAttractShowRuns) {
  std::jthread editor([this] {
    for (int i = 0; i < 600 && log().find("exhibit started") == std::string::npos; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    write("visitor.toml", "[hole]\nspin = \n");
  });
  ASSERT_EQ(exhibit("--for 4"), 0) << output_;
  EXPECT_THAT(log(), HasSubstr("visitor.toml:2"));
}

//! Sends a signal to one process. Does nothing for -1, which kill() would interpret as all
//! processes.
void signal_one(pid_t process, int number) {
  if (process > 0) {
    ::kill(process, number);
  }
}

//! Returns the rendering process of an exhibit. The exhibit has two processes with the same command
//! line, and this is the one whose parent is the other. Returns -1 if there is none.
pid_t showing_process(const std::string& command_line) {
  const auto line_of = [](const std::string& process) {
    std::ifstream file("/proc/" + process + "/cmdline");
    std::string line{std::istreambuf_iterator<char>(file), {}};
    std::ranges::replace(line, '\0', ' ');
    return line;
  };
  for (const auto& each : std::filesystem::directory_iterator("/proc")) {
    const std::string process = each.path().filename().string();
    std::ifstream stat(each.path() / "stat");
    std::string skipped;
    std::string parent;
    stat >> skipped >> skipped >> skipped >> parent;
    if (line_of(process).find(command_line) != std::string::npos && line_of(parent) == line_of(process)) {
      return std::stoi(process);
    }
  }
  return -1;
}

TEST_F(ExhibitInAWindow, IsStartedAgainAfterACrash) {
  const std::string begins = "exhibit started";
  const auto logged_begins = [&] {
    const std::string text = log();
    int count = 0;
    for (std::size_t at = text.find(begins); at != std::string::npos; at = text.find(begins, at + 1)) {
      ++count;
    }
    return count;
  };
  const std::string screenshot = (folder_ / "of_this_test.png").string();
  std::jthread crash([&](const std::stop_token& over) {
    const auto wait = [&](const std::function<bool()>& until) {
      while (!over.stop_requested() && !until()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    };
    wait([&] { return logged_begins() > 0; });
    // The exhibit does not restart a process that crashes soon after its start, so the test waits
    // before it kills the process.
    std::this_thread::sleep_for(std::chrono::seconds(6));
    signal_one(showing_process(screenshot), SIGKILL);
    wait([&] { return logged_begins() > 1; });
    signal_one(showing_process(screenshot), SIGTERM);
  });
  EXPECT_EQ(exhibit("--for 60 --screenshot '" + screenshot + "'"), 0) << output_;
  EXPECT_EQ(logged_begins(), 2);
  EXPECT_THAT(output_, HasSubstr("the exhibit crashed (Killed); restarting it"));
}

TEST_F(ExhibitInAWindow, StartsWhateverIsDamagedInItsFolders) {
  std::filesystem::create_directories(folder_ / "state" / "ergodome" / "settings.toml.bad" / "a folder");
  std::filesystem::create_directories(folder_ / "ergodome");
  std::string deep = "a";
  for (int i = 0; i < 30'000; ++i) {
    deep += ".a";
  }
  for (const char* const name : {"state/ergodome/settings.toml", "ergodome/controls.toml", "ergodome/pads.toml"}) {
    write(name, deep + " = 1\n");
  }
  ::mkfifo((folder_ / "state" / "ergodome" / "ergodome.log").c_str(), 0600);
  EXPECT_EQ(exhibit("--for 0.2"), 0) << output_;
}

TEST_F(CommandLine, AnExhibitThatCannotBeginSaysSoInItsLog) {
  ::setenv("XDG_STATE_HOME", folder_.c_str(), 1);
  EXPECT_EQ(run("play missing.toml --exhibit"), 1);
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_THAT(text("ergodome/ergodome.log"), HasSubstr("missing.toml"));
}

}  // namespace
}  // namespace ergodome
