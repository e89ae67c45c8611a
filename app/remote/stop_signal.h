#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <vector>

#include "app/remote/descriptor.h"

namespace ergodome {

//! Tells threads that wait for sockets to end: every wait returns at once after `raise`.
class StopSignal {
 public:
  enum class Wake { ready, stopped, timeout };

  //! Throws Error where the system has no descriptors left.
  StopSignal();

  void raise();
  [[nodiscard]] bool is_raised() const;

  //! Waits until a socket has one of poll's `events` (or an error), the signal is raised, or the deadline has passed.
  [[nodiscard]] Wake wait(int socket, short events, std::chrono::steady_clock::time_point deadline) const;
  //! The same for any of several sockets.
  [[nodiscard]] Wake wait(std::vector<pollfd> sockets, std::chrono::steady_clock::time_point deadline) const;
  //! Waits for the signal or the deadline alone; true where it was raised.
  [[nodiscard]] bool sleep_until(std::chrono::steady_clock::time_point deadline) const;

 private:
  Descriptor event_;
};

}  // namespace ergodome
