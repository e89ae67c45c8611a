#include "app/cli/interrupt.h"

#include <csignal>

#include "content/files/whole_file.h"

namespace ergodome {

namespace {

volatile std::sig_atomic_t stop_wanted = 0;

void note_signal(int signal) {
  stop_wanted = 1;
  stop_reading();
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

void stop_on_hangup() {
  std::signal(SIGHUP, [](int /*signal*/) {
    stop_wanted = 1;
    stop_reading();
  });
}

void fail_at_file_limits() { std::signal(SIGXFSZ, SIG_IGN); }

void end_on_interrupts() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool interrupted() { return stop_wanted != 0; }

}  // namespace ergodome
