#include "app/cli/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace ergodome {
namespace {

TEST(Progress, IsALineNowAndThenWithoutATerminal) {
  if (::isatty(STDERR_FILENO) != 0) {
    GTEST_SKIP() << "the standard error is a terminal";
  }
  testing::internal::CaptureStderr();
  {
    Progress progress("baking", 100);
    progress.advance_to(10);
    std::this_thread::sleep_for(std::chrono::milliseconds(5100));
    progress.advance_to(50);
    progress.advance_to(51);
    progress.advance_to(100);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "ergodome: baking: 50 of 100, 5.1 s left\n");
}

}  // namespace
}  // namespace ergodome
