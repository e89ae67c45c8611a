#include "app/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/cli/summary_text.h"
#include "content/files/console.h"

namespace ergodome {

Progress::Progress(std::string what, long total)
    : what_(std::move(what)),
      total_(total),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (std::exchange(drawn_, false)) {
    std::fputs("\r\033[K", stderr);
  }
}

void Progress::draw_bar(long done, double left_s) const {
  constexpr long cells = 30;
  const long filled = cells * done / total_;
  const std::string bar =
      std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(cells - filled), '.');
  const std::string line =
      fmt::format("\r\033[K{} [{}] {} of {}, {} left", what_, bar, done, total_, duration_text(left_s));
  std::fputs(line.c_str(), stderr);
}

void Progress::advance_to(long done) {
  using std::chrono::duration;
  const auto now = Clock::now();
  const double spent_s = duration<double>(now - start_).count();
  if (done <= 0) {
    return;
  }
  const double left_s = spent_s * static_cast<double>(total_ - done) / static_cast<double>(done);
  if (!on_terminal_) {
    if (spent_s >= next_line_s_ && done < total_) {
      constexpr double longest_pause_s = 60.0;
      next_line_s_ = spent_s + std::min(next_line_s_, longest_pause_s);
      print_note("{}: {} of {}, {} left", what_, done, total_, duration_text(left_s));
    }
    return;
  }
  if (spent_s < 2.0 || duration<double>(now - last_).count() < 0.2) {
    return;
  }
  last_ = now;
  drawn_ = true;
  draw_bar(done, left_s);
}

}  // namespace ergodome
