#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <vector>

#include "app/remote/common/net_address.h"

namespace ergodome {

//! Stops threads that wait for sockets: every wait returns at once after `raise`.
class StopSignal {
 public:
  enum class Wake { ready, stopped, timeout };

  //! Throws Error if the system has no descriptors left.
  StopSignal();

  void raise();
  [[nodiscard]] bool is_raised() const;

  //! Waits until a socket has one of poll's `events` (or an error), the signal is raised, or the
  //! deadline has passed.
  [[nodiscard]] Wake wait(int socket, short events, std::chrono::steady_clock::time_point deadline) const;
  //! Waits until one of several sockets has one of its `events` (or an error), the signal is
  //! raised, or the deadline has passed.
  [[nodiscard]] Wake wait(std::vector<pollfd> sockets, std::chrono::steady_clock::time_point deadline) const;
  //! Waits for the signal or the deadline; returns whether the signal was raised.
  [[nodiscard]] bool sleep_until(std::chrono::steady_clock::time_point deadline) const;

 private:
  Descriptor event_;
};

}  // namespace ergodome
