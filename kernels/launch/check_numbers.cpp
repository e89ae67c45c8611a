#include "kernels/launch/check_numbers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "kernels/core/error.h"
#include "kernels/launch/cuda.h"

namespace ergodome {

namespace {

std::atomic<bool>& flag() {
  static std::atomic<bool> checked = [] {
    const char* wish = std::getenv("ERGODOME_CHECK_NUMBERS");
    return wish != nullptr && std::strcmp(wish, "0") != 0 && *wish != '\0';
  }();
  return checked;
}

//! Maximum number of values that are copied from a device at a time.
constexpr long block = 1 << 16;

template <class S>
void require(const std::string& kernel, Backend backend, const char* channel, const S* values, long count) {
  if (values == nullptr) {
    return;
  }
  std::vector<S> copy(backend == Backend::cuda ? static_cast<std::size_t>(std::min(block, count)) : 0);
  for (long first = 0; first < count; first += block) {
    const long length = std::min(block, count - first);
    const S* here = values + first;
    if (backend == Backend::cuda) {
      copy_from_cuda(copy.data(), here, static_cast<std::size_t>(length) * sizeof(S));
      here = copy.data();
    }
    const S* bad = std::find_if(here, here + length, [](S value) { return !std::isfinite(value); });
    if (bad != here + length) {
      throw Error("kernel " + kernel,
                  std::string(channel) + "[" + std::to_string(first + (bad - here)) + "] of " + std::to_string(count) +
                      " is " + std::to_string(*bad),
                  "report this with the show to the developers, or unset ERGODOME_CHECK_NUMBERS");
    }
  }
}

}  // namespace

bool numbers_are_checked() { return flag().load(std::memory_order_relaxed); }
void set_numbers_checked(bool on) { flag().store(on, std::memory_order_relaxed); }

void require_finite(const std::string& kernel, Backend backend, const char* channel, const float* values, long count) {
  require(kernel, backend, channel, values, count);
}

void require_finite(const std::string& kernel, Backend backend, const char* channel, const double* values, long count) {
  require(kernel, backend, channel, values, count);
}

}  // namespace ergodome
