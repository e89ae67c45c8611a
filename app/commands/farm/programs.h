#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace ergodome {

//! How a program ended, and what it printed.
struct ProgramResult {
  int status = 0;      //!< exit status; 128 and more: ended by a signal
  std::string output;  //!< stdout and stderr
};

//! Runs a program, found in PATH, and waits until it ends. Throws Error, with `remedy`, if it cannot
//! be started.
ProgramResult run_and_read(const std::vector<std::string>& words, const std::string& remedy);

//! Starts a program without output in a process group of its own, so that Ctrl-C does not reach it.
//! Throws Error if it cannot be started.
pid_t start_program(const std::vector<std::string>& words);

//! Returns the exit status from a status of waitpid(); 128 and the signal's number if a signal ended
//! the process.
int exit_status(int wait_status);

}  // namespace ergodome
