#pragma once

#include <string>
#include <vector>

#include "app/playback/transport.h"

namespace ergodome {

//! Produces log lines of operators' commands with the address that they came from.
//!
//! Commands of the same kind and address become one line with the last value and their number, once
//! none has come for a second, or five seconds after the first. So a moving fader does not fill the
//! log.
class OperatorLog {
 public:
  //! Maximum number of lines that wait for repetitions. One more makes the oldest due at once.
  static constexpr std::size_t max_waiting = 32;

  //! Adds commands at a time of a monotonic clock. Commands without a source come from the program
  //! and produce no line.
  void note(const std::vector<TransportCommand>& commands, double now_s);

  //! Returns the lines that are due.
  [[nodiscard]] std::vector<std::string> take(double now_s);
  //! Returns all remaining lines at the end of the program.
  [[nodiscard]] std::vector<std::string> take_all();

 private:
  struct Waiting {
    TransportCommand command;
    int count = 1;
    double first_s = 0.0;
    double last_s = 0.0;
  };

  std::vector<Waiting> waiting_;
  std::vector<std::string> ready_;
};

}  // namespace ergodome
