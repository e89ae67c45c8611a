#include "app/playback/watched_shows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "content/show/reading/show_reader.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

const std::string sound_show = "[hole]\nspin = 0.5\n[[camera.key]]\nr = 12\n";
const std::string broken_show = "[hole]\nspin = \n";

//! Two shows, one running and one waiting.
class WatchedShowsTest : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write("attract.toml", sound_show);
    write("visitor.toml", sound_show);
    shows_.add(read_show(folder_ / "visitor.toml"), read_at_, read_show);
    run("attract.toml");
    frames();
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  void run(const std::string& name) { shows_.run(read_show(folder_ / name), read_at_, read_show); }

  //! Runs a version that was read earlier, whatever the file contains.
  void run_as_it_was(const std::string& name) {
    Show show;
    show.name = name;
    show.folder = folder_.string();
    shows_.run(show, read_at_, read_show);
  }

  //! Polls for several seconds of player time.
  void frames() {
    for (int i = 0; i < 300; ++i) {
      now_ += milliseconds(10);
      // Shows are read on separate threads.
      std::this_thread::sleep_for(milliseconds(1));
      if (auto result = shows_.poll(now_)) {
        version_ = std::move(result);
      }
      if (auto waiting = shows_.poll_waiting(now_)) {
        waiting_ = std::move(waiting);
        ++told_of_waiting_;
      }
    }
  }

  FileWatch::WallTime read_at_ = std::chrono::system_clock::now() + std::chrono::minutes(1);
  WatchedShows shows_;
  MonotonicTime now_ = std::chrono::seconds(1000);
  std::optional<ShowReload::Result> version_;
  std::optional<WatchedShows::Waiting> waiting_;
  int told_of_waiting_ = 0;
};

TEST_F(WatchedShowsTest, HaveNothingToTellWhileNothingChanges) {
  EXPECT_EQ(shows_.problem(), "");
  EXPECT_FALSE(version_);
  EXPECT_FALSE(waiting_);
}

TEST_F(WatchedShowsTest, OneThatWaitsAndIsBrokenIsToldOnce) {
  write("visitor.toml", broken_show);
  frames();
  frames();
  ASSERT_TRUE(waiting_);
  EXPECT_THAT(waiting_->problem, HasSubstr("visitor.toml"));
  EXPECT_EQ(told_of_waiting_, 1);
}

TEST_F(WatchedShowsTest, TheProblemStandsWhateverRunsUntilTheFileIsMended) {
  write("visitor.toml", broken_show);
  frames();
  for (const char* name : {"attract", "visitor", "attract"}) {
    run_as_it_was(name);
    frames();
    EXPECT_THAT(shows_.problem(), HasSubstr("visitor.toml")) << name;
  }
  write("visitor.toml", sound_show + "[tone]\nexposure_stops = 1\n");
  frames();
  EXPECT_EQ(shows_.problem(), "");
}

TEST_F(WatchedShowsTest, OneThatWasSavedWhileItWaitedIsReadWhenItRuns) {
  write("visitor.toml", sound_show + "[tone]\nexposure_stops = 1\n");
  frames();
  EXPECT_FALSE(version_);
  run("visitor.toml");
  frames();
  ASSERT_TRUE(version_ && version_->show);
  EXPECT_EQ(version_->show->name, "visitor");
}

TEST_F(WatchedShowsTest, AVersionThatDidNotComeToRunIsReadAgain) {
  write("attract.toml", sound_show + "[tone]\nexposure_stops = 1\n");
  frames();
  ASSERT_TRUE(version_ && version_->show);
  shows_.forget_version();
  run("visitor.toml");
  version_.reset();
  run("attract.toml");
  frames();
  EXPECT_TRUE(version_ && version_->show);
}

TEST_F(WatchedShowsTest, OfTwoBrokenOnesTheOneThatRunsIsTold) {
  write("visitor.toml", broken_show);
  write("attract.toml", broken_show);
  frames();
  EXPECT_THAT(shows_.problem(), HasSubstr("attract.toml"));
}

}  // namespace
}  // namespace ergodome
