#include "app/commands/farm/farm_status.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>
#include <map>
#include <memory>
#include <set>

#include "app/commands/farm/local_engine.h"
#include "app/commands/farm/slurm_engine.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr std::array state_words = {"done", "running", "waiting", "failed", "not started"};

QueueQuery slurm_query(const FarmRun& run) {
  const auto jobs = std::make_shared<std::map<std::string, std::string>>(slurm_jobs(run.folder));
  const auto queue = std::make_shared<std::map<std::pair<std::string, int>, std::string>>(slurm_queue());
  return [jobs, queue](const FarmStep& step, std::size_t index) {
    const auto job = jobs->find(step.name);
    const auto found = job == jobs->end() ? queue->end() : queue->find({job->second, static_cast<int>(index) + 1});
    if (found == queue->end()) {
      return QueueState::absent;
    }
    return found->second == "RUNNING" || found->second == "COMPLETING" ? QueueState::running : QueueState::waiting;
  };
}

TaskState state_of(const std::vector<const Attempt*>& attempts, QueueState queue) {
  if (std::ranges::any_of(attempts, [](const Attempt* each) { return each->status == 0; })) {
    return TaskState::done;
  }
  if (queue == QueueState::running && !attempts.empty() && !attempts.back()->status) {
    return TaskState::running;
  }
  if (queue != QueueState::absent) {
    return TaskState::waiting;
  }
  return attempts.empty() ? TaskState::not_started : TaskState::failed;
}

//! Adds the frame numbers of names such as NAME_000001.png in a folder and its subfolders of ten
//! thousand frames.
void add_numbers(const fs::path& folder, const std::string& prefix, bool within, std::set<int>& numbers) {
  std::error_code problem;
  for (fs::directory_iterator each(folder, problem), end; !problem && each != end; each.increment(problem)) {
    const std::string name = each->path().filename().string();
    if (!name.starts_with(prefix)) {
      continue;
    }
    std::error_code no_kind;
    int number = 0;
    const auto [rest, failed] = std::from_chars(name.data() + prefix.size(), name.data() + name.size(), number);
    if (each->is_directory(no_kind)) {
      if (within) {
        add_numbers(each->path(), prefix, false, numbers);
      }
    } else if (failed == std::errc() && rest != name.data() + name.size()) {
      numbers.insert(number - 1);
    }
  }
}

std::string clock_text(std::int64_t seconds) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(static_cast<std::time_t>(seconds)));
}

std::string text_of_running(const TaskStatus& task) {
  return fmt::format("running: {} {} on {} since {}; log: {}\n", task.step, task.task, printable(task.attempt->host),
                     clock_text(task.attempt->began_s), task.attempt->log.string());
}

std::string text_of_failed(const TaskStatus& task) {
  const Attempt& attempt = *task.attempt;
  const std::string end = attempt.status
                              ? fmt::format("with status {} at {}", *attempt.status, clock_text(attempt.ended_s))
                              : "without a status: it was killed, or its machine failed";
  const std::string said = last_line_of_log(attempt);
  return fmt::format("failed: {} {} on {} ended {}{}\n  log: {}\n", task.step, task.task, printable(attempt.host), end,
                     said.empty() ? "" : "\n  " + printable(shortened(said, 300)), attempt.log.string());
}

std::string counts_of(const std::string& step, const std::vector<TaskStatus>& tasks) {
  std::string text;
  for (std::size_t state = 0; state < state_words.size(); ++state) {
    const auto count = std::ranges::count_if(tasks, [&](const TaskStatus& each) {
      return each.step == step && each.state == static_cast<TaskState>(state);
    });
    if (count > 0) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state_words[state]);
    }
  }
  return text;
}

}  // namespace

QueueQuery queue_of(const FarmRun& run) {
  if (run.engine == "slurm") {
    return slurm_query(run);
  }
  const bool runs = run.engine != "local" || running_local_farm(FarmFolder(run.plan.out).path());
  return [runs](const FarmStep&, std::size_t) { return runs ? QueueState::running : QueueState::absent; };
}

std::vector<TaskStatus> task_statuses(const FarmRun& run, const std::vector<Attempt>& attempts,
                                      const QueueQuery& queue) {
  std::map<std::pair<std::string, std::string>, std::vector<const Attempt*>> of_task;
  for (const Attempt& attempt : attempts) {
    of_task[{attempt.step, attempt.task}].push_back(&attempt);
  }
  std::vector<TaskStatus> statuses;
  for (const FarmStep& step : run.plan.steps) {
    for (std::size_t i = 0; i < step.tasks.size(); ++i) {
      const std::vector<const Attempt*>& own = of_task[{step.name, step.tasks[i]}];
      TaskStatus& status =
          statuses.emplace_back(TaskStatus{step.name, step.tasks[i], state_of(own, queue(step, i)), {}});
      if (!own.empty()) {
        status.attempt = *own.back();
      }
    }
  }
  return statuses;
}

int existing_frames(const FarmPlan& plan) {
  std::set<int> numbers;
  // Frames of separate eyes are in L and R, one for one.
  for (const char* folder : {".", "L"}) {
    add_numbers(plan.out / folder, plan.name + "_", true, numbers);
  }
  return static_cast<int>(
      std::ranges::count_if(numbers, [&](int frame) { return frame >= plan.film.first && frame <= plan.film.last; }));
}

std::string status_text(const FarmRun& run, const std::vector<TaskStatus>& tasks) {
  const FarmPlan& plan = run.plan;
  std::string text =
      fmt::format("{}: {} of {} exist in {}\nrun {} ({}):\n", printable(plan.name), existing_frames(plan),
                  counted(plan.film.last - plan.film.first + 1, "frame"), plan.out.string(), run.number, run.engine);
  for (const FarmStep& step : plan.steps) {
    text += fmt::format("  {:<8} {}\n", step.name, counts_of(step.name, tasks));
  }
  for (const TaskStatus& task : tasks) {
    text += task.state == TaskState::running ? text_of_running(task) : "";
  }
  bool failed = false;
  for (const TaskStatus& task : tasks) {
    if (task.state == TaskState::failed) {
      text += text_of_failed(task);
      failed = true;
    }
  }
  if (failed && !is_active(tasks)) {
    text += "run the same ergodome farm command again to repair the film\n";
  }
  return text;
}

bool is_active(const std::vector<TaskStatus>& tasks) {
  return std::ranges::any_of(tasks, [](const TaskStatus& each) {
    return each.state == TaskState::running || each.state == TaskState::waiting;
  });
}

}  // namespace ergodome
