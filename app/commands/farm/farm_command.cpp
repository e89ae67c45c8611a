#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/option_checks.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/commands/farm/farm_film.h"
#include "app/commands/farm/farm_folder.h"
#include "app/commands/farm/farm_options.h"
#include "app/commands/farm/farm_scripts.h"
#include "app/commands/farm/farm_status.h"
#include "app/commands/farm/given_options.h"
#include "app/commands/farm/local_engine.h"
#include "app/commands/farm/openjd_template.h"
#include "app/commands/farm/slurm_engine.h"
#include "app/commands/render/render_arguments.h"
#include "content/files/console.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr const char* template_file = "job.json";

std::vector<TaskStatus> statuses_of(const FarmRun& run) {
  return task_statuses(run, read_attempts(run.folder), queue_of(run));
}

//! Prints the status of a film. Throws Error if tasks have failed, so that scripts notice.
void print_status(const fs::path& out) {
  const FarmRun run = newest_farm_run(out);
  const std::vector<TaskStatus> tasks = statuses_of(run);
  print_out("{}", status_text(run, tasks));
  const auto failed = std::ranges::count_if(tasks, [](const auto& each) { return each.state == TaskState::failed; });
  if (failed > 0) {
    throw Error("farm", fmt::format("{} failed", counted(failed, "task")), "their logs are named above");
  }
}

void cancel_film(const fs::path& out) {
  const FarmRun run = newest_farm_run(out);
  if (run.engine == "openjd") {
    throw Error(out.string(), "was submitted through a job template, which this program does not control",
                "cancel the job in its scheduler");
  }
  if (run.engine == "slurm") {
    std::vector<std::string> jobs;
    for (const auto& [step, job] : slurm_jobs(run.folder)) {
      jobs.push_back(job);
    }
    if (!jobs.empty()) {
      cancel_slurm_jobs(jobs);
    }
    print_out("{} canceled\n", counted(jobs.size(), "job"));
    return;
  }
  const std::optional<LocalFarm> farm = running_local_farm(FarmFolder(out).path());
  if (!farm) {
    throw Error(out.string(), "no farm is running", "see --status");
  }
  stop_local_farm(*farm);
  print_out("process {} was asked to stop\n", farm->process);
}

//! Throws Error if the newest run of a film still has tasks in a queue: a new run would render the
//! same frames again.
void require_idle(const fs::path& out, const std::string& engine) {
  if (FarmFolder(out).newest_run() == 0) {
    return;
  }
  const FarmRun run = newest_farm_run(out);
  if (run.engine != "slurm") {
    return;  // a local farm holds a lock, and other schedulers cannot be asked
  }
  bool active = false;
  try {
    active = is_active(statuses_of(run));
  } catch (const Error& problem) {
    if (engine == "slurm") {
      throw;
    }
    // The film may be finished on a machine without Slurm.
    print_note("{}; tasks of run {} may still be in Slurm's queue", problem.problem(), run.number);
  }
  if (active) {
    throw Error(out.string(), fmt::format("run {} still has tasks in Slurm's queue", run.number),
                "wait until they end (--status), or stop them with --cancel");
  }
}

RunFiles files_of(const FarmOptions& options, const FarmPlan& plan, const fs::path& run) {
  RunFiles files = farm_scripts(plan, run);
  if (options.engine == "slurm") {
    files["submit.sh"] = slurm_submission(plan, options.resources, run);
  } else if (options.engine == "openjd") {
    files[template_file] = openjd_template(plan, options.resources, run);
  }
  return files;
}

void print_files(const RunFiles& files) {
  for (const auto& [name, text] : files) {
    print_out("### {}\n{}\n", name, text);
  }
}

std::string steps_text(const FarmPlan& plan) {
  std::string text;
  for (const FarmStep& step : plan.steps) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", step.name, counted(step.tasks.size(), "task"));
  }
  return text;
}

void start_run(const FarmOptions& options, const FarmPlan& plan, const fs::path& run) {
  const std::string out = options.render.out;
  if (options.engine == "slurm") {
    submit_to_slurm(run);
    print_out("submitted: {}\nergodome farm --status {} lists the tasks\n", steps_text(plan), out);
  } else if (options.engine == "openjd") {
    print_out("job template written to {}: {}\n", (run / template_file).string(), steps_text(plan));
  } else {
    run_locally(plan, run, options.jobs > 0 ? options.jobs : usual_jobs());
    print_out("{} in {}\n", counted(plan.film.last - plan.film.first + 1, "frame"), out);
  }
}

void make_film(FarmOptions& options, const std::vector<std::string>& words) {
  if (options.render.show.empty()) {
    throw UsageError("farm", "has nothing to render", "name a show file or a built-in show");
  }
  if (options.render.out.find("{{") != std::string::npos && options.engine == "openjd") {
    throw UsageError("--out " + options.render.out, "contains {{, which job templates replace",
                     "choose another folder");
  }
  options.render.out = fs::absolute(options.render.out).lexically_normal().string();
  require_idle(options.render.out, options.engine);
  const FarmFolder folder(options.render.out);
  const FarmFilm film = farm_film(options, words);
  std::optional<LocalLock> lock;
  if (options.engine == "local" && !options.dry_run) {
    lock.emplace(folder.path());
  }
  const FarmPlan plan = farm_plan(options, film);
  const int number = folder.newest_run() + 1;
  const RunFiles files = files_of(options, plan, folder.run_folder(number));
  if (options.dry_run) {
    return print_files(files);
  }
  folder.write_run(number, options.engine, plan, files);
  start_run(options, plan, folder.run_folder(number));
}

//! Returns a check for a value that becomes a word of sbatch's command line.
CLI::Validator plain_word() {
  return {[](const std::string& text) {
            return text.empty() || find_control(text) != std::string::npos || text.find('\n') != std::string::npos
                       ? std::string("is empty or has control characters")
                       : std::string();
          },
          ""};
}

void add_task_options(CLI::App& command, FarmOptions& options) {
  TaskResources& resources = options.resources;
  command.option_defaults()->group("Tasks");
  command
      .add_option("--chunk", options.chunk, "frames that a task renders (default: measured; a task takes two minutes)")
      ->check(CLI::Range(1, 1'000'000));
  command
      .add_option("--bake", options.bake_parts,
                  "bake the camera path first, in N parts; 0: never (default: if possible, a part for 300 frames)")
      ->check(CLI::Range(0, 1000));
  command
      .add_option("--jobs", options.jobs,
                  "with --engine local: tasks that run at the same time (default: one for 8 threads)")
      ->check(CLI::Range(1, 256));
  command.add_option("--program", options.program, "program that the tasks run (default: this one)")
      ->type_name("FILE")
      ->check(plain_word());
  command
      .add_option("--container", options.container,
                  "command that runs a program in a container, such as \"apptainer exec --nv ergodome.sif\"")
      ->type_name("COMMAND")
      ->check(plain_word());
  command.add_option("--cpus", resources.cpus, "CPUs of a task (default: the scheduler's)")->check(CLI::Range(1, 1024));
  command.add_option("--memory", resources.memory, "memory of a task, such as 8G (default: the scheduler's)")
      ->type_name("SIZE")
      ->check([](const std::string& text) {
        return memory_mib(text) > 0 ? "" : "\"" + text + "\" is not an amount of memory; write, for example, 8G";
      });
  command.add_option("--gpus", resources.gpus, "GPUs of a task, as a number or TYPE:NUMBER (default: none)")
      ->type_name("GPUS")
      ->check(plain_word());
  command.add_option("--time", resources.time, "time limit of a task, such as 30 (minutes) or 1:00:00")
      ->type_name("TIME")
      ->check(plain_word());
  command.add_option("--partition", resources.partition, "Slurm's partition")->type_name("NAME")->check(plain_word());
  command.add_option("--account", resources.account, "Slurm's account")->type_name("NAME")->check(plain_word());
}

//! Registers the options that have no effect with the chosen engine.
void add_engine_rules(const std::shared_ptr<FarmOptions>& options, IgnoredOptions& ignored) {
  ignored.add("without --engine slurm", [options] { return options->engine != "slurm"; },
              {"--partition", "--account", "--time"});
  ignored.add("with --engine local", [options] { return options->engine == "local"; },
              {"--cpus", "--memory", "--gpus"});
  ignored.add("without --engine local", [options] { return options->engine != "local"; }, {"--jobs"});
}

//! Returns the options of a film that its tasks get unchanged.
std::vector<std::string> film_options(const CLI::App& command, const std::vector<std::string>& own) {
  std::vector<std::string> left_out = own;
  for (const char* each : {"--help", "--frames", "--from", "--to", "--movie", "--language", "--budget"}) {
    left_out.emplace_back(each);
  }
  return given_options(command, left_out);
}

//! Returns the names of a command's options so far.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    names.push_back(option->get_name());
  }
  return names;
}

}  // namespace

void add_farm_command(CLI::App& app) {
  auto options = std::make_shared<FarmOptions>();
  options->render.out.clear();
  CLI::App* command = app.add_subcommand(
      "farm", "Render a film on the machines of a scheduler, or in parallel on this one; repairs a film");
  command->add_option("show", options->render.show, "show file (.toml) or name of a built-in show");
  CLI::Option* const out =
      command->add_option("--out", options->render.out, "folder for the frames, which all machines share")
          ->type_name("DIR")
          ->check(plain_word());
  command->add_option("--engine", options->engine, "what runs the tasks")
      ->check(CLI::IsMember({"local", "slurm", "openjd"}))
      ->capture_default_str();
  command->add_flag("--dry-run", options->dry_run, "print the scripts, and change nothing");
  CLI::Option* const status =
      command->add_option("--status", options->status, "list the tasks of the film in DIR, with the logs of failures")
          ->type_name("DIR")
          ->check(plain_word());
  CLI::Option* const cancel = command->add_option("--cancel", options->cancel, "stop the tasks of the film in DIR")
                                  ->type_name("DIR")
                                  ->check(plain_word())
                                  ->excludes(status);
  out->excludes(status)->excludes(cancel);
  add_task_options(*command, *options);
  const auto own = std::make_shared<std::vector<std::string>>(option_names(*command));
  command->option_defaults()->group("Frames");
  add_set_option(*command, options->render.set);
  command->add_option("--size", options->render.size_px, "width of one eye's image in pixels (default: the show's)")
      ->check(CLI::Range(1, 16384));
  IgnoredOptions ignored(*command);
  add_film_options(*command, options->render, ignored);
  add_engine_rules(options, ignored);
  command->callback([options, ignored, command, own, out] {
    ignored.refuse();
    if (!options->status.empty()) {
      return print_status(options->status);
    }
    if (!options->cancel.empty()) {
      return cancel_film(options->cancel);
    }
    if (out->count() == 0) {
      throw UsageError("farm", "has no folder for the frames", "add --out DIR");
    }
    make_film(*options, film_options(*command, *own));
  });
}

}  // namespace ergodome
