#pragma once

#include <string>
#include <vector>

#include "app/playback/transport.h"

namespace ergodome {

//! Makes lines for the log of what operators change: what was asked, and from which address.
//!
//! A line waits for a second, so that a fader that moves becomes one line with its last value, and a flood of commands does not fill the log.
class OperatorLog {
 public:
  //! Commands that wait for their line. More make the oldest line ready at once.
  static constexpr std::size_t most_waiting = 32;

  //! Takes commands at a time of a clock that never goes back. Those without a source are the program's own, and make no line.
  void note(const std::vector<TransportCommand>& commands, double now_s);

  //! Returns the lines that are ready.
  [[nodiscard]] std::vector<std::string> take(double now_s);
  //! Returns all that are left: the program ends.
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
