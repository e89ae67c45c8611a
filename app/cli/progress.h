#pragma once

#include <chrono>
#include <string>

namespace ergodome {

//! The progress of long work on the standard error: on a terminal a bar with the time left, from two seconds on; elsewhere, in a log
//! for instance, a line after five seconds and then ever more seldom, at last each minute.
class Progress {
 public:
  Progress(std::string what, long total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance_to(long done);
  //! Erases the bar before other lines are printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(long done, double left_s) const;

  std::string what_;
  long total_;
  bool on_terminal_;
  bool drawn_ = false;
  double next_line_s_ = 5.0;
  Clock::time_point start_;
  Clock::time_point last_;
};

}  // namespace ergodome
