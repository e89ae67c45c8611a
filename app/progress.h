#pragma once

#include <chrono>
#include <string>

namespace ergodome {

//! A progress bar with the time left, on a terminal, from two seconds on; silent elsewhere.
class Progress {
 public:
  Progress(std::string what, long total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance_to(long done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  long total_;
  bool on_terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point last_;
};

}  // namespace ergodome
