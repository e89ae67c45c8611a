#include "app/exhibit/saved_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/exhibit/log_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/killed_writer.h"

namespace ergodome {
namespace {

using SavedSettingsTest = test::FolderTest;
using LogFileTest = test::FolderTest;

TEST_F(SavedSettingsTest, AreReadAsTheyWereWritten) {
  const SavedSettings written = {
      .exposure_stops = -1.25, .baseline = 0.4, .volume = 0.5, .language = "de", .captions = false};
  std::string problem;
  write_saved_settings(folder_ / "deep" / "settings.toml", written);
  EXPECT_EQ(read_saved_settings(folder_ / "deep" / "settings.toml", problem), written);
  EXPECT_EQ(problem, "");
}

TEST_F(SavedSettingsTest, AreTheUsualOnesWhereThereIsNoFile) {
  std::string problem;
  EXPECT_EQ(read_saved_settings(folder_ / "none.toml", problem), SavedSettings());
  EXPECT_EQ(problem, "");
}

TEST_F(SavedSettingsTest, OfADamagedFileAreTheUsualOnesAndTheFileIsKept) {
  for (const char* text : {"exposure_stops = ", "exposure_stops = nan", "colour = 1", "volume = 7", "\xff\xfe"}) {
    std::ofstream(folder_ / "settings.toml") << text;
    std::string problem;
    EXPECT_EQ(read_saved_settings(folder_ / "settings.toml", problem), SavedSettings()) << text;
    EXPECT_NE(problem, "") << text;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "settings.toml")) << text;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "settings.toml.bad")) << text;
  }
}

TEST_F(SavedSettingsTest, AreOldOrNewWhateverMomentTheProgramIsKilledIn) {
  const std::filesystem::path file = folder_ / "settings.toml";
  test::kill_while_writing(
      [&](int i) {
        write_saved_settings(file, {.exposure_stops = (i % 40) / 4.0, .language = std::string(1 + i % 30, 'x')});
      },
      [&] {
        std::string problem;
        read_saved_settings(file, problem);
        EXPECT_EQ(problem, "");
      });
  for (const auto& each : std::filesystem::directory_iterator(folder_)) {
    EXPECT_EQ(each.path(), file);
  }
}

TEST_F(LogFileTest, IsBoundedHoweverMuchIsLogged) {
  const auto log = open_log(folder_ / "log" / "ergodome.log", {});
  for (int i = 0; i < 100'000; ++i) {
    log->info("line {} of a log that must not fill the disk of an exhibit which runs for months", i);
  }
  std::uintmax_t bytes = 0;
  for (const auto& each : std::filesystem::directory_iterator(folder_ / "log")) {
    bytes += each.file_size();
  }
  EXPECT_LE(bytes, 5U << 20U);
  EXPECT_GT(bytes, 4U << 20U);
}

TEST_F(LogFileTest, GoesOnWithoutAFileWhereNoneCanBeWritten) {
  std::ofstream(folder_ / "file") << "not a folder";
  const auto log = open_log(folder_ / "file" / "ergodome.log", {});
  EXPECT_NO_THROW(log->info("still here"));
}

TEST_F(LogFileTest, OnAFullDiskIsToldOnceOnTheStandardError) {
  std::filesystem::create_symlink("/dev/full", folder_ / "ergodome.log");
  const auto log = open_log(folder_ / "ergodome.log", {});
  testing::internal::CaptureStderr();
  log->info("one");
  log->info("two");
  const std::string reported = testing::internal::GetCapturedStderr();
  EXPECT_THAT(reported, testing::HasSubstr("ergodome.log: cannot write the log"));
  EXPECT_EQ(std::ranges::count(reported, '\n'), 1) << reported;
}

}  // namespace
}  // namespace ergodome
