#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

namespace ergodome::test {

//! Tests that killing a process while it writes does no harm. Twenty times, starts a child process
//! that calls `write` again and again, kills it (kill -9) after a few milliseconds, and calls
//! `check`. The argument of `write` counts up from 0 in each process. Finally calls `write` in this
//! process, because on a slow machine no earlier call may have finished.
inline void kill_while_writing(const std::function<void(int)>& write, const std::function<void()>& check) {
  for (int round = 0; round < 20; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = 0;; ++i) {
        write(i);
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 3 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    check();
  }
  write(0);
  check();
}

}  // namespace ergodome::test
