#include "app/commands/farm/slurm_engine.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "app/commands/farm/programs.h"
#include "app/commands/farm/shell_words.h"
#include "content/files/printable.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr const char* slurm_remedy = "run this on a machine from which jobs are submitted, or choose another --engine";

//! Returns the last line of a program's output, for a message.
std::string last_output_line(const std::string& output) {
  std::istringstream lines(output);
  std::string last = "it prints nothing";
  for (std::string line; std::getline(lines, line);) {
    last = line.empty() ? last : line;
  }
  return printable(last);
}

std::vector<std::string> resource_options(const TaskResources& resources) {
  std::vector<std::string> options;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      options.push_back(std::string(option) + "=" + value);
    }
  };
  add("--partition", resources.partition);
  add("--account", resources.account);
  add("--time", resources.time);
  add("--mem", resources.memory);
  add("--gpus", resources.gpus);
  add("--cpus-per-task", resources.cpus > 0 ? std::to_string(resources.cpus) : "");
  return options;
}

//! Doubles the percent signs, which sbatch would replace in names of files.
std::string without_patterns(const std::string& path) {
  std::string plain;
  for (const char c : path) {
    plain += c == '%' ? "%%" : std::string(1, c);
  }
  return plain;
}

std::string succeeded(const ProgramResult& result, const char* program) {
  if (result.status != 0) {
    throw Error(program, last_output_line(result.output), "check the options for Slurm and the state of the cluster");
  }
  return result.output;
}

}  // namespace

std::string slurm_submission(const FarmPlan& plan, const TaskResources& resources, const std::filesystem::path& run) {
  const std::string options = shell_words(resource_options(resources));
  std::string script = fmt::format(
      R"(#!/bin/bash
# Submits the steps of {} to Slurm. Each step waits until the one before has succeeded.
set -Eeuo pipefail
run={}
job=

cancel_all() {{
  echo "no step is left in the queue: a step could not be submitted" >&2
  while read -r _ number; do scancel "$number" || true; done <"$run/jobs"
}}
: >"$run/jobs"
trap cancel_all ERR

# Submits a step after the one before.
submit() {{
  local step=$1
  shift
  [[ -z $job ]] || set -- --dependency="afterok:$job" --kill-on-invalid-dep=yes "$@"
  job=$(sbatch --parsable --requeue --open-mode=append {}"$@" "$run/$step.sh")
  job=${{job%%;*}}
  echo "$step $job" >>"$run/jobs"
}}

)",
      printable(plan.name), shell_word(run.string()), options.empty() ? "" : options + " ");
  for (const FarmStep& step : plan.steps) {
    const std::string log =
        without_patterns(run.string()) + "/slurm-" + step.name + (step.tasks.size() > 1 ? "-%a" : "");
    script += fmt::format("submit {} --job-name={} --output={}", step.name, shell_word(plan.name + "-" + step.name),
                          shell_word(log + ".log"));
    script += step.task_option.empty() ? "\n" : fmt::format(" --array=1-{}\n", step.tasks.size());
  }
  return script;
}

void submit_to_slurm(const std::filesystem::path& run) {
  succeeded(run_and_read({"sbatch", "--version"}, slurm_remedy), "sbatch");
  succeeded(run_and_read({"bash", (run / "submit.sh").string()}, slurm_remedy), "sbatch");
}

std::map<std::string, std::string> slurm_jobs(const std::filesystem::path& run) {
  std::map<std::string, std::string> jobs;
  std::ifstream file(run / "jobs");
  for (std::string step, job; file >> step >> job;) {
    jobs[step] = job;
  }
  return jobs;
}

std::map<std::pair<std::string, int>, std::string> parse_queue(const std::string& lines) {
  std::map<std::pair<std::string, int>, std::string> states;
  std::istringstream stream(lines);
  for (std::string job, index, state; stream >> job >> index >> state;) {
    states[{job, index == "N/A" ? 1 : std::atoi(index.c_str())}] = state;
  }
  return states;
}

std::map<std::pair<std::string, int>, std::string> slurm_queue() {
  return parse_queue(succeeded(
      run_and_read({"squeue", "--me", "--noheader", "--array", "--format=%F %K %T"}, slurm_remedy), "squeue"));
}

void cancel_slurm_jobs(const std::vector<std::string>& jobs) {
  std::vector<std::string> words = {"scancel"};
  words.insert(words.end(), jobs.begin(), jobs.end());
  succeeded(run_and_read(words, slurm_remedy), "scancel");
}

}  // namespace ergodome
