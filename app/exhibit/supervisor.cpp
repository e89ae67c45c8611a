#include "app/exhibit/supervisor.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "app/cli/interrupt.h"
#include "content/files/console.h"
#include "kernels/core/error.h"

namespace ergodome {

void notify_supervisor_ready() { sd_notify(0, "READY=1"); }

void notify_supervisor_alive(double now_s) {
  static double notified_s = -1.0;
  if (notified_s < 0.0 || std::abs(now_s - notified_s) >= 1.0) {
    notified_s = now_s;
    sd_notify(0, "WATCHDOG=1");
  }
}

void notify_supervisor(std::string status) {
  static std::string notified;
  // A newline would start another message.
  std::ranges::replace(status, '\n', ' ');
  if (status != notified) {
    notified = status;
    sd_notify(0, ("STATUS=" + status).c_str());
  }
}

namespace {

using std::chrono::steady_clock;

//! A program that fails in less time than this is not restarted, because it would fail again.
constexpr std::chrono::seconds shortest_run{5};

volatile std::sig_atomic_t stopping = 0;
volatile pid_t running = 0;

//! Forwards a signal to the child as SIGHUP. The child may also have received the signal itself, as
//! with Ctrl-C, and a second SIGINT or SIGTERM would end it at once (interrupt.h).
void pass_on(int /*signal*/) {
  stopping = 1;
  if (running > 0) {
    ::kill(running, SIGHUP);
  }
}

void set_handlers(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, handler);
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

//! Ends this process with the signal or exit status of the child.
[[noreturn]] void end_like(int status) {
  if (WIFSIGNALED(status)) {
    set_handlers(SIG_DFL);
    ::raise(WTERMSIG(status));
  }
  ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : 1);
}

}  // namespace

void restart_after_crashes() {
  std::fflush(stdout);  // otherwise both processes would print the buffered text
  while (true) {
    const auto begin = steady_clock::now();
    set_handlers(pass_on);
    // Blocks signals until the child has its handlers and the parent has stored the child's id.
    sigset_t held;
    sigset_t before;
    sigfillset(&held);
    sigprocmask(SIG_BLOCK, &held, &before);
    const pid_t child = ::fork();
    if (child < 0) {
      throw Error("exhibit", std::string("cannot be started: ") + std::strerror(errno), "close other programs");
    }
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      catch_interrupts();
      stop_on_hangup();
      sigprocmask(SIG_SETMASK, &before, nullptr);
      return;
    }
    running = child;
    sigprocmask(SIG_SETMASK, &before, nullptr);
    const int status = wait_for(child);
    running = 0;
    const bool failed = WIFSIGNALED(status) || WEXITSTATUS(status) != 0;
    if (!failed || stopping != 0 || steady_clock::now() - begin < shortest_run) {
      end_like(status);
    }
    print_note("the exhibit crashed ({}); restarting it", WIFSIGNALED(status)
                                                              ? std::string(::strsignal(WTERMSIG(status)))
                                                              : fmt::format("exit status {}", WEXITSTATUS(status)));
  }
}

}  // namespace ergodome
