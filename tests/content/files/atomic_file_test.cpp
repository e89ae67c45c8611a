#include "content/files/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFile : public test::FolderTest {
 protected:
  [[nodiscard]] long files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
};

TEST_F(AtomicFile, ReplacesAnOlderFileWhole) {
  write_text_atomically(folder_ / "a.txt", "old");
  write_text_atomically(folder_ / "a.txt", "new");
  EXPECT_EQ(text("a.txt"), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, WritesWhatALinkNamesAndKeepsTheLink) {
  write_text_atomically(folder_ / "a.txt", "old");
  fs::create_symlink("a.txt", folder_ / "link.txt");
  write_text_atomically(folder_ / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(text("a.txt"), "new");
}

TEST_F(AtomicFile, WritesWhatALinkNamesAndIsNotThereYet) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink(fs::absolute(folder_ / "elsewhere" / "b.txt"), folder_ / "link.txt");
  write_text_atomically(folder_ / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(text("elsewhere/b.txt"), "new");
}

TEST_F(AtomicFile, RefusesALinkThatLeadsBackToItself) {
  fs::create_symlink("two", folder_ / "one");
  fs::create_symlink("one", folder_ / "two");
  EXPECT_THAT(test::error_of([&] { write_text_atomically(folder_ / "one", "text"); }), HasSubstr("points to itself"));
}

TEST_F(AtomicFile, ReplacesNoPipeAndNoFolder) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_directory(folder_ / "folder");
  for (const char* name : {"pipe", "folder"}) {
    EXPECT_THAT(test::error_of([&] { write_text_atomically(folder_ / name, "text"); }),
                HasSubstr("a directory or device with that name exists"));
  }
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFile, KeepsWhatWasThereBesideWhatIsWrittenOverIt) {
  const auto file = folder_ / "warp.data";
  write_text_keeping_older(file, "first");
  EXPECT_FALSE(fs::exists(folder_ / "warp.data.bak"));
  write_text_keeping_older(file, "other");
  write_text_keeping_older(file, "other");
  EXPECT_EQ(text("warp.data"), "other");
  EXPECT_EQ(text("warp.data.bak"), "first");
}

TEST_F(AtomicFile, KeepsTheOlderFileWhenWritingFails) {
  write_text_atomically(folder_ / "a.txt", "old");
  EXPECT_THROW(write_atomically(folder_ / "a.txt",
                                [](const fs::path& partial) {
                                  std::ofstream(partial) << "half";
                                  throw Error("test", "stopped");
                                }),
               Error);
  EXPECT_EQ(text("a.txt"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, FolderThatIsNotThereIsAnErrorWithTheName) {
  EXPECT_THAT(test::error_of([&] { write_text_atomically(folder_ / "no" / "a.txt", "x"); }), HasSubstr("a.txt"));
}

TEST_F(AtomicFile, WhatAKilledProgramLeftIsRemovedAndNothingElse) {
  const pid_t killed = ::fork();
  if (killed == 0) {
    write_atomically(folder_ / "film.mp4", [](const fs::path& partial) {
      std::ofstream(partial) << "half";
      ::_exit(0);
    });
  }
  ::waitpid(killed, nullptr, 0);
  EXPECT_EQ(files(), 1);
  std::ofstream(folder_ / ".partial-film.mp4") << "another program's file";
  std::ofstream(folder_ / "film-0123456789abcdef") << "another file";
  write_atomically(folder_ / "own.mp4", [this](const fs::path& partial) {
    std::ofstream(partial) << "whole";
    remove_abandoned_files(folder_);
  });
  EXPECT_EQ(files(), 3);
  EXPECT_EQ(text("own.mp4"), "whole");
}

//! A limit on the size of files simulates a full disk: the same system calls fail in the same way.
TEST_F(AtomicFile, FullDiskLeavesNothingBehind) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string problem =
      test::error_of([&] { write_text_atomically(folder_ / "big.txt", std::string(100'000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(problem, HasSubstr("big.txt"));
  EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace ergodome
