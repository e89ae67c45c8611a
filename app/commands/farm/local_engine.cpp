#include "app/commands/farm/local_engine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <thread>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "app/commands/farm/farm_attempts.h"
#include "app/commands/farm/programs.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr const char* lock_file = "local";

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

//! Tasks of a step that run at the same time.
class RunningTasks {
 public:
  RunningTasks() = default;
  ~RunningTasks() {
    stop();
    while (!processes_.empty()) {
      wait();
    }
  }
  RunningTasks(const RunningTasks&) = delete;
  RunningTasks& operator=(const RunningTasks&) = delete;

  void start(const fs::path& script, const std::string& task) {
    processes_[start_program({"bash", script.string(), task})] = task;
  }
  //! Asks all tasks to stop, once.
  void stop() {
    if (!std::exchange(stopped_, true)) {
      for (const auto& [process, task] : processes_) {
        ::kill(-process, SIGTERM);
      }
    }
  }
  //! Waits a moment, at most until a task ends.
  void wait() {
    for (auto each = processes_.begin(); each != processes_.end(); ++each) {
      int status = 0;
      if (::waitpid(each->first, &status, WNOHANG) == each->first) {
        failed_ += exit_status(status) != 0 ? 1 : 0;
        processes_.erase(each);
        return;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  [[nodiscard]] std::size_t count() const { return processes_.size(); }
  [[nodiscard]] int failed() const { return failed_; }

 private:
  std::map<pid_t, std::string> processes_;
  bool stopped_ = false;
  int failed_ = 0;
};

//! Runs the tasks of a step. Returns the number of failed tasks; throws Error if interrupted.
int run_step(const FarmStep& step, const fs::path& run, int jobs) {
  Progress progress(step.description, static_cast<long>(step.tasks.size()));
  RunningTasks running;
  std::size_t next = 0;
  while ((next < step.tasks.size() && !interrupted()) || running.count() > 0) {
    while (next < step.tasks.size() && running.count() < static_cast<std::size_t>(jobs) && !interrupted()) {
      running.start(run / (step.name + ".sh"), step.tasks[next++]);
    }
    if (interrupted()) {
      running.stop();
    }
    running.wait();
    progress.advance_to(static_cast<long>(next - running.count()));
  }
  if (interrupted()) {
    throw Error("farm", "was stopped", "run it again to continue");
  }
  return running.failed();
}

[[noreturn]] void report_failed_step(const FarmStep& step, const fs::path& run, int failed) {
  const std::vector<Attempt> attempts = read_attempts(run);
  const auto last = std::ranges::find_if(attempts.rbegin(), attempts.rend(), [&](const Attempt& each) {
    return each.step == step.name && each.status.value_or(1) != 0;
  });
  const std::string where = last == attempts.rend() ? ""
                                                    : fmt::format("; the last one ({}) printed: {}", last->task,
                                                                  printable(last_line_of_log(*last)));
  throw Error("farm", fmt::format("{} of step {} failed{}", counted(failed, "task"), step.name, where),
              "see --status, and run the command again to repair the film");
}

}  // namespace

LocalLock::LocalLock(const fs::path& farm_folder) {
  make_folder(farm_folder);
  const fs::path file = farm_folder / lock_file;
  handle_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (handle_ < 0) {
    throw Error(file.string(), std::string("cannot be written: ") + std::strerror(errno),
                "check the folder and its permissions");
  }
  if (::flock(handle_, LOCK_EX | LOCK_NB) != 0) {
    ::close(handle_);
    throw Error(farm_folder.parent_path().string(), "is in use by another ergodome farm",
                "wait until it ends, or stop it with --cancel");
  }
  const std::string owner = fmt::format("{} {}\n", ::getpid(), host_name());
  if (::ftruncate(handle_, 0) != 0 || !write_all(handle_, owner.data(), owner.size())) {
    ::close(handle_);
    throw Error(file.string(), std::string("cannot be written: ") + std::strerror(errno), "free some space");
  }
}

LocalLock::~LocalLock() { ::close(handle_); }

std::optional<LocalFarm> running_local_farm(const fs::path& farm_folder) {
  const fs::path file = farm_folder / lock_file;
  const int handle = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (handle < 0) {
    return std::nullopt;
  }
  const bool held = ::flock(handle, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(handle);
  LocalFarm farm;
  std::ifstream owner(file);
  return held && owner >> farm.process >> farm.host ? std::optional(farm) : std::nullopt;
}

void stop_local_farm(const LocalFarm& farm) {
  if (farm.host != host_name()) {
    throw Error("farm", fmt::format("runs on {}, process {}", farm.host, farm.process), "run --cancel there");
  }
  if (::kill(farm.process, SIGTERM) != 0 && errno != ESRCH) {
    throw Error("farm", fmt::format("process {} cannot be stopped: {}", farm.process, std::strerror(errno)),
                "stop it as its owner");
  }
}

int usual_jobs() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency() + 7) / 8); }

void run_locally(const FarmPlan& plan, const fs::path& run, int jobs) {
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / jobs);
  // Tasks that run at the same time share the CPU; a limit that the user has set is kept.
  ::setenv("ERGODOME_THREADS", std::to_string(std::min(threads, 256)).c_str(), 0);
  for (const FarmStep& step : plan.steps) {
    if (const int failed = run_step(step, run, jobs); failed > 0) {
      report_failed_step(step, run, failed);
    }
    print_out("{}: {} done\n", step.name, counted(step.tasks.size(), "task"));
  }
}

}  // namespace ergodome
