#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

namespace ergodome::test {

//! Writes again and again, in a process of its own that is killed (kill -9) at any moment, and checks what is there then; twenty times. `write`
//! is given a number that grows, from 0 in each process. Writes once more in the end without being killed: on a slow machine that may be all that is ever written.
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
