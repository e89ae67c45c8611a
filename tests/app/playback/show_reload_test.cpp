#include "app/playback/show_reload.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <thread>

#include "content/show/reading/show_reader.h"
#include "tests/support/folder_test.h"

namespace ergodome {

namespace {

using namespace std::chrono_literals;

constexpr const char* first_version = "title = \"First\"\nduration_s = 10\n[[camera.key]]\nr = 10\n";
constexpr const char* second_version = "title = \"Second\"\nduration_s = 20\n[[camera.key]]\nr = 10\n";

class HotReload : public test::FolderTest {
 protected:
  void SetUp() override {
    test::FolderTest::SetUp();
    write("show.toml", first_version);
    watch_since(std::chrono::system_clock::now() + 1s);
  }

  //! Starts to watch the show file, which was read at the given time of the wall clock.
  void watch_since(std::chrono::system_clock::time_point read_at) {
    reload_.emplace(folder_ / "show.toml", read_show(folder_ / "show.toml"), read_at, read_show);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  //! Writes a temporary file and renames it, as some editors do when they save.
  void write_beside(const std::string& name, const std::string& text) const {
    write(name + "~", text);
    std::filesystem::rename(folder_ / (name + "~"), folder_ / name);
  }

  //! Polls every frame for a while; returns the last result.
  std::optional<ShowReload::Result> run(std::chrono::nanoseconds time = 1s) {
    std::optional<ShowReload::Result> last;
    for (const MonotonicTime end = now_ + time; now_ < end; now_ += 16ms) {
      if (auto result = poll()) {
        ++results_;
        last = std::move(result);
      }
    }
    return last;
  }

  //! Polls for one frame; if that starts to read a file, waits until it is read.
  std::optional<ShowReload::Result> poll() {
    auto result = reload_->poll(now_);
    while (!result && reload_->is_reading()) {
      std::this_thread::sleep_for(1ms);
      result = reload_->poll(now_);
    }
    return result;
  }

  MonotonicTime now_ = 100s;
  int results_ = 0;
  std::optional<ShowReload> reload_;
};

TEST_F(HotReload, AShowThatStaysIsNotReadAgain) { EXPECT_FALSE(run(5s)); }

TEST_F(HotReload, ASavedShowIsReadOnce) {
  run();
  write("show.toml", second_version);
  const auto result = run(3s);
  ASSERT_TRUE(result && result->show);
  EXPECT_EQ(text_in(result->show->title, ""), "Second");
  EXPECT_EQ(results_, 1);
}

TEST_F(HotReload, AnEditorMayRenameItsFileOverIt) {
  run();
  write_beside("show.toml", second_version);
  const auto result = run();
  ASSERT_TRUE(result && result->show);
  EXPECT_EQ(text_in(result->show->title, ""), "Second");
}

TEST_F(HotReload, AVersionOfTheSameLengthIsSeen) {
  run();
  write_beside("show.toml", "title = \"Fifth\"\nduration_s = 10\n[[camera.key]]\nr = 10\n");
  const auto result = run();
  ASSERT_TRUE(result && result->show);
  EXPECT_EQ(text_in(result->show->title, ""), "Fifth");
}

TEST_F(HotReload, ABrokenEditKeepsTheRunningVersionAndSaysWhyOnce) {
  run();
  write("show.toml", "title = \"Second\nduration_s = 20\n");
  const auto result = run(3s);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->show);
  EXPECT_THAT(result->problem, testing::HasSubstr("show.toml"));
  EXPECT_EQ(results_, 1);
  write("show.toml", second_version);
  const auto mended = run();
  ASSERT_TRUE(mended && mended->show);
  EXPECT_EQ(mended->problem, "");
}

TEST_F(HotReload, AVersionThatWasSavedBeforeItsFileWasWatchedIsRead) {
  write("show.toml", second_version);
  watch_since(std::chrono::system_clock::now() - 5s);
  const auto result = run(3s);
  ASSERT_TRUE(result && result->show);
  EXPECT_EQ(results_, 1);
}

TEST_F(HotReload, AFileThatIsStillBeingWrittenIsWaitedFor) {
  run();
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, std::size_t{40}}) {
    write("show.toml", std::string(second_version).substr(0, length));
    EXPECT_FALSE(run(120ms));
  }
  write("show.toml", second_version);
  const auto result = run();
  ASSERT_TRUE(result && result->show);
  EXPECT_EQ(results_, 1);
}

TEST_F(HotReload, AFileThatVanishesForAMomentIsWaitedFor) {
  run();
  std::filesystem::remove(folder_ / "show.toml");
  EXPECT_FALSE(run(1s));
  write("show.toml", "");
  EXPECT_FALSE(run(1s)) << "and so is one that is empty";
  write("show.toml", second_version);
  const auto result = run();
  ASSERT_TRUE(result && result->show);
}

TEST_F(HotReload, AFileThatStaysAwayIsToldOnceAndReadWhenItIsBack) {
  run();
  std::filesystem::rename(folder_ / "show.toml", folder_ / "away");
  const auto gone = run(9s);
  ASSERT_TRUE(gone);
  EXPECT_THAT(gone->problem, testing::HasSubstr("show.toml: no longer exists"));
  EXPECT_EQ(results_, 1);
  std::filesystem::rename(folder_ / "away", folder_ / "show.toml");
  const auto back = run();
  ASSERT_TRUE(back && back->show);
  EXPECT_EQ(back->problem, "");
}

TEST_F(HotReload, AFileThatStaysEmptyIsToldOnce) {
  run();
  write("show.toml", "");
  const auto empty = run(9s);
  ASSERT_TRUE(empty);
  EXPECT_THAT(empty->problem, testing::HasSubstr("show.toml: is empty"));
  EXPECT_EQ(results_, 1);
}

TEST_F(HotReload, AFileTheShowNamesIsWatchedEvenBeforeItIsThere) {
  write("show.toml", std::string(first_version) + "[sky]\nmap = \"sky.exr\"\n");
  ASSERT_TRUE(run());
  EXPECT_FALSE(run());
  write("sky.exr", "light");
  const auto result = run();
  EXPECT_TRUE(result && result->show);
}

TEST_F(HotReload, ReadsAtOnceOnRequest) {
  write("show.toml", second_version);
  reload_->request();
  const auto result = poll();
  ASSERT_TRUE(result && result->show);
  EXPECT_EQ(text_in(result->show->title, ""), "Second");
  std::filesystem::remove(folder_ / "show.toml");
  reload_->request();
  const auto gone = poll();
  ASSERT_TRUE(gone);
  EXPECT_THAT(gone->problem, testing::HasSubstr("no longer exists or is not a file"));
}

TEST_F(HotReload, DoesNotWaitForAFileThatTakesLongToRead) {
  std::promise<void> read;
  reload_.emplace(folder_ / "show.toml", read_show(folder_ / "show.toml"), std::chrono::system_clock::now(),
                  [ready = read.get_future().share()](const std::filesystem::path& file) {
                    ready.wait();
                    return read_show(file);
                  });
  reload_->request();
  EXPECT_FALSE(reload_->poll(now_));
  EXPECT_TRUE(reload_->is_reading());
  EXPECT_FALSE(reload_->poll(now_));
  read.set_value();
  const auto result = poll();
  EXPECT_TRUE(result && result->show);
}

TEST_F(HotReload, FilesOfAShowAreThoseItNames) {
  Show show;
  show.folder = "/shows";
  show.name = "a";
  show.sky.map = "sky.exr";
  show.sky.stars = "stars.csv";
  show.shells.resize(2);
  show.shells[1].texture = "clouds.png";
  show.objects.resize(1);
  show.objects[0].mesh = "planet.glb";
  show.timeline.overlays.resize(2);
  show.timeline.overlays[0].image = "logo.png";
  show.timeline.overlays[1].image = "logo.png";
  show.timeline.audio.resize(1);
  show.timeline.audio[0].file = "/music/a.flac";
  EXPECT_THAT(files_of(file_of(show), show),
              testing::ElementsAre("/shows/a.toml", "/shows/sky.exr", "/shows/stars.csv", "/shows/clouds.png",
                                   "/shows/planet.glb", "/shows/logo.png", "/music/a.flac"));
}

}  // namespace

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

  //! Runs a show that contains only a name and a folder, as if it had been read earlier; the file
  //! of that name may have other contents by now.
  void run_as_it_was(const std::string& name) {
    Show show;
    show.name = name;
    show.folder = folder_.string();
    shows_.run(show, read_at_, read_show);
  }

  //! Polls for several seconds of simulated player time.
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
        ++reported_waiting_;
      }
    }
  }

  FileWatch::WallTime read_at_ = std::chrono::system_clock::now() + std::chrono::minutes(1);
  WatchedShows shows_;
  MonotonicTime now_ = std::chrono::seconds(1000);
  std::optional<ShowReload::Result> version_;
  std::optional<WatchedShows::Waiting> waiting_;
  int reported_waiting_ = 0;
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
  EXPECT_EQ(reported_waiting_, 1);
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
