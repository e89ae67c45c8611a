#include "app/commands/farm/farm_scripts.h"

#include <fmt/format.h>

#include "app/commands/farm/shell_words.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

//! Runs one task, and records its attempt in a file of its own. A task may have several attempts,
//! even at the same time: a machine that is believed to have failed may finish its work.
constexpr const char* attempt_script = R"(# Functions of the steps' scripts, which set `run` to the folder of this run.

# Prints the task to run: the argument, or the line of STEP.tasks that the Slurm array names. Open Job
# Description writes ranges of frames as 1-12.
task_of() {
  local step=$1 given=${2:-}
  [[ -n $given ]] || given=$(sed -n "${SLURM_ARRAY_TASK_ID:-1}p" "$run/$step.tasks")
  printf '%s\n' "${given/-/:}"
}

# Runs a command for a task, and records when and where it began and how it ended.
attempt() {
  local step=$1 task=$2 status=0 host=${SLURMD_NODENAME:-$HOSTNAME} record
  shift 2
  record="$run/attempts/$step-${task//[\/:]/-}.$host-$$-$RANDOM"
  printf 'began %(%s)T %s %s %s %s\n' -1 "$step" "$task" "$$" "$host" >"$record"
  # A signal ends the command; this script then records that.
  trap : INT TERM
  "$@" >"$record.log" 2>&1 || status=$?
  printf 'ended %(%s)T %s\n' -1 "$status" >>"$record"
  ((status == 0)) || tail -n 20 "$record.log" >&2
  return "$status"
}

# Uses as many threads as Slurm grants.
threads=${SLURM_CPUS_PER_TASK:-${SLURM_CPUS_ON_NODE:-}}
[[ -z $threads ]] || export ERGODOME_THREADS=$threads
)";

}  // namespace

std::string step_script(const FarmPlan& plan, const FarmStep& step, const std::filesystem::path& run) {
  const std::string option = step.task_option.empty() ? "" : " " + step.task_option + " \"$task\"";
  return fmt::format(
      "#!/bin/bash\n"
      "# {}: {}\n"
      "run={}\n"
      ". \"$run/attempt.sh\"\n"
      "task=$(task_of {} \"${{1:-}}\") || exit\n"
      "cd {} || exit\n"
      "attempt {} \"$task\" {} {}{}\n",
      printable(plan.name), step.description, shell_word(run.string()), step.name,
      shell_word(plan.work_folder.string()), step.name, plan.program, shell_words(step.words), option);
}

RunFiles farm_scripts(const FarmPlan& plan, const std::filesystem::path& run) {
  RunFiles files = {{"attempt.sh", attempt_script}};
  for (const FarmStep& step : plan.steps) {
    files[step.name + ".sh"] = step_script(plan, step, run);
    std::string tasks;
    for (const std::string& task : step.tasks) {
      tasks += task + "\n";
    }
    files[step.name + ".tasks"] = tasks;
  }
  return files;
}

}  // namespace ergodome
