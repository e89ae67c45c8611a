#pragma once

#include <chrono>
#include <string>

namespace ergodome {

//! Shows the progress of long work on stderr: on a terminal as a bar with the remaining time, after
//! two seconds; otherwise, such as in a log, as a line after five seconds and then less and less
//! often, down to once a minute.
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
