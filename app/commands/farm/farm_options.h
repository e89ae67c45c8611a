#pragma once

#include <string>

#include "app/commands/render/render_options.h"

namespace ergodome {

//! Resources of a task; empty: the scheduler's default.
struct TaskResources {
  int cpus = 0;  //!< 0: the scheduler's default
  std::string memory;
  std::string gpus;
  std::string time;
  std::string partition;
  std::string account;
};

//! Returns an amount of memory, "8G" or "500M" or in MiB without a unit, in MiB; 0 for other text.
long memory_mib(const std::string& text);

//! Options of `farm`.
struct FarmOptions {
  RenderOptions render;
  std::string engine = "local";
  int chunk = 0;        //!< frames of a task; 0: chosen from measured times
  int bake_parts = -1;  //!< parts of the bake; 0: no bake, -1: chosen from the number of frames
  int jobs = 0;         //!< tasks that run at the same time with the engine local; 0: chosen from the CPU
  std::string program;  //!< program of the tasks; empty: this one, or with a container `ergodome`
  std::string container;
  TaskResources resources;
  bool dry_run = false;
  std::string status;  //!< folder of a film whose progress is listed
  std::string cancel;  //!< folder of a film whose tasks are stopped
};

}  // namespace ergodome
