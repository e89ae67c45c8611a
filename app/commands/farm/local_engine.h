#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/commands/farm/farm_plan.h"

namespace ergodome {

//! The lock of the engine local: while a farm runs on this machine, it holds the lock on the file
//! `local` in the folder of the film, which names the process and its host.
class LocalLock {
 public:
  //! Takes the lock. Throws Error if another farm holds it.
  explicit LocalLock(const std::filesystem::path& farm_folder);
  ~LocalLock();
  LocalLock(const LocalLock&) = delete;
  LocalLock& operator=(const LocalLock&) = delete;

 private:
  int handle_ = -1;
};

//! A farm that runs on a machine.
struct LocalFarm {
  int process = 0;
  std::string host;
};

//! Returns the farm that holds the lock of a film, or nothing.
std::optional<LocalFarm> running_local_farm(const std::filesystem::path& farm_folder);

//! Asks a running farm to stop. Throws Error if it runs on another machine.
void stop_local_farm(const LocalFarm& farm);

//! Returns the number of tasks that run at the same time by default: one for each eight threads of
//! the CPU, because a task uses several.
int usual_jobs();

//! Runs the steps of a plan with the scripts in the folder `run`, at most `jobs` tasks at a time.
//! Throws Error after a step with a failed task, and if interrupted.
void run_locally(const FarmPlan& plan, const std::filesystem::path& run, int jobs);

}  // namespace ergodome
