#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/farm/farm_options.h"
#include "app/commands/farm/farm_plan.h"

namespace ergodome {

//! Returns the script that submits the steps of a plan to Slurm: arrays of tasks, each step after
//! the success of the one before. It writes the numbers of the jobs to the file `jobs`, and cancels
//! all if one cannot be submitted.
std::string slurm_submission(const FarmPlan& plan, const TaskResources& resources, const std::filesystem::path& run);

//! Runs the submission script of a run. Throws Error with sbatch's message.
void submit_to_slurm(const std::filesystem::path& run);

//! Returns Slurm's job number of each submitted step of a run.
std::map<std::string, std::string> slurm_jobs(const std::filesystem::path& run);

//! Parses squeue's lines "JOB INDEX STATE", where the index of a job without an array is "N/A". The
//! keys of the result are the job and the index, which is 1 without an array.
std::map<std::pair<std::string, int>, std::string> parse_queue(const std::string& lines);

//! Returns the state ("RUNNING", "PENDING", ...) of this user's tasks in Slurm's queue. Throws Error
//! if squeue fails.
std::map<std::pair<std::string, int>, std::string> slurm_queue();

//! Cancels jobs. Throws Error with scancel's message.
void cancel_slurm_jobs(const std::vector<std::string>& jobs);

}  // namespace ergodome
