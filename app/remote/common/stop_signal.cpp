#include "app/remote/common/stop_signal.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

int milliseconds_until(std::chrono::steady_clock::time_point deadline) {
  // Rounded up, so that a wait does not return just before its deadline.
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
  return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 60'000));
}

}  // namespace

StopSignal::StopSignal() : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!event_.is_open()) {
    throw Error("remote control", std::string("cannot make an event: ") + std::strerror(errno),
                "close other programs, or raise the limit of open files (ulimit -n)");
  }
}

void StopSignal::raise() {
  const std::uint64_t one = 1;
  // If this fails because the counter is at its maximum, the waiting threads wake up as well.
  [[maybe_unused]] const ssize_t written = ::write(event_.get(), &one, sizeof one);
}

bool StopSignal::is_raised() const { return sleep_until(std::chrono::steady_clock::time_point::min()); }

StopSignal::Wake StopSignal::wait(int socket, short events, std::chrono::steady_clock::time_point deadline) const {
  return wait({{socket, events, 0}}, deadline);
}

StopSignal::Wake StopSignal::wait(std::vector<pollfd> sockets, std::chrono::steady_clock::time_point deadline) const {
  sockets.push_back({event_.get(), POLLIN, 0});
  while (true) {
    const int wait_ms = milliseconds_until(deadline);
    const int ready = ::poll(sockets.data(), sockets.size(), wait_ms);
    if (sockets.back().revents != 0) {
      return Wake::stopped;
    }
    if (ready > 0) {
      return Wake::ready;
    }
    if (ready == 0 && std::chrono::steady_clock::now() >= deadline) {
      return Wake::timeout;
    }
    if (ready < 0 && errno != EINTR) {
      return Wake::stopped;
    }
  }
}

bool StopSignal::sleep_until(std::chrono::steady_clock::time_point deadline) const {
  return wait({}, deadline) == Wake::stopped;
}

}  // namespace ergodome
