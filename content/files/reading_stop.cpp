#include "content/files/reading_stop.h"

#include <atomic>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

std::atomic<bool> stopped = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may store it");

}  // namespace

void stop_reading() noexcept { stopped.store(true, std::memory_order_relaxed); }

void require_reading_goes_on(const std::string& place) {
  if (stopped.load(std::memory_order_relaxed)) {
    throw Error(place, "was not read completely, because the program was asked to stop", "run it again");
  }
}

}  // namespace ergodome
