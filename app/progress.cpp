#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace ergodome {

Progress::Progress(std::string what, long total)
    : what_(std::move(what)),
      total_(total),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (drawn_) {
    std::fputs("\r\033[K", stderr);
  }
}

void Progress::advance_to(long done) {
  using std::chrono::duration;
  const auto now = Clock::now();
  const double spent_s = duration<double>(now - start_).count();
  if (!on_terminal_ || done <= 0 || spent_s < 2.0 || duration<double>(now - last_).count() < 0.2) {
    return;
  }
  last_ = now;
  drawn_ = true;
  constexpr long cells = 30;
  const long filled = cells * done / total_;
  const double left_s = spent_s * static_cast<double>(total_ - done) / static_cast<double>(done);
  const std::string bar =
      std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(cells - filled), '.');
  const std::string line = fmt::format("\r\033[K{} [{}] {} of {}, {:.0f} s left", what_, bar, done, total_, left_s);
  std::fputs(line.c_str(), stderr);
}

}  // namespace ergodome
