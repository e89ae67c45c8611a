#pragma once

#include <filesystem>
#include <string>

#include "app/commands/farm/farm_folder.h"

namespace ergodome {

//! Returns the scripts with which every engine runs the tasks of a plan: STEP.sh runs the task that
//! is its argument, or in a Slurm array the one in the array's line of STEP.tasks. `run` is the
//! absolute folder of the run, in which attempts are recorded.
RunFiles farm_scripts(const FarmPlan& plan, const std::filesystem::path& run);

//! Returns the script of a step.
std::string step_script(const FarmPlan& plan, const FarmStep& step, const std::filesystem::path& run);

}  // namespace ergodome
