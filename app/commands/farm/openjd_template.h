#pragma once

#include <filesystem>
#include <string>

#include "app/commands/farm/farm_options.h"
#include "app/commands/farm/farm_plan.h"

namespace ergodome {

//! Maximum number of frames in a task: AWS Deadline Cloud accepts no larger chunks.
inline constexpr int max_openjd_chunk = 150;

//! Returns a job template of Open Job Description (jobtemplate-2023-09 with TASK_CHUNKING) as JSON.
//! Its tasks run the scripts of a plan in the folder `run`, which all machines must share.
std::string openjd_template(const FarmPlan& plan, const TaskResources& resources, const std::filesystem::path& run);

}  // namespace ergodome
