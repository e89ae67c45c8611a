#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/farm/farm_attempts.h"
#include "app/commands/farm/farm_folder.h"

namespace ergodome {

enum class TaskState { done, running, waiting, failed, not_started };

//! A task of a run with its newest attempt.
struct TaskStatus {
  std::string step;
  std::string task;
  TaskState state = TaskState::not_started;
  std::optional<Attempt> attempt;
};

//! What the engine knows of a task.
enum class QueueState { absent, waiting, running };

//! Returns what the engine knows of the task with this index, from 0, of a step.
using QueueQuery = std::function<QueueState(const FarmStep& step, std::size_t index)>;

//! Returns a query for a run: Slurm's queue, or whether the local farm still runs. Open Job
//! Description has no queue: attempts that have not ended count as running, and other tasks as
//! waiting. Throws Error if Slurm cannot be asked.
QueueQuery queue_of(const FarmRun& run);

//! Returns the status of every task of a run.
std::vector<TaskStatus> task_statuses(const FarmRun& run, const std::vector<Attempt>& attempts,
                                      const QueueQuery& queue);

//! Returns the number of frames of a film that exist, complete or not.
int existing_frames(const FarmPlan& plan);

//! Describes a film for people: its frames, the tasks of each step, what runs, and each failed task
//! with the last line of its log and the log's name.
std::string status_text(const FarmRun& run, const std::vector<TaskStatus>& tasks);

//! Returns whether tasks are running or waiting, so that a new run would repeat their work.
bool is_active(const std::vector<TaskStatus>& tasks);

}  // namespace ergodome
