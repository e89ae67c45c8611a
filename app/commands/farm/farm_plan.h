#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ergodome {

//! A step of a film: one command, which runs for each task. Tasks of a step are independent.
struct FarmStep {
  std::string name;                //!< also the name of its script
  std::string description;         //!< for people: "renders frames"
  std::vector<std::string> words;  //!< command and options of the program
  std::string task_option;         //!< option whose value is the task; empty: the step has one task
  std::vector<std::string> tasks;  //!< "1/4" or "13:24"; one task without an option: "all"
};

//! A range of frames, counted from 0, with both ends.
struct FrameChunk {
  int first = 0;
  int last = 0;
};

//! How a film is made: its steps, of which each begins when all tasks of the one before have
//! succeeded.
struct FarmPlan {
  std::string name;                   //!< of the show
  std::filesystem::path out;          //!< folder of the frames, absolute
  std::filesystem::path work_folder;  //!< folder in which the tasks run, absolute
  std::string program;                //!< start of a shell command: the program, perhaps in a container
  FrameChunk film;                    //!< all frames of the film
  int chunk = 1;                      //!< frames of a task
  std::vector<FarmStep> steps;
};

struct FarmFilm;
struct FarmOptions;

//! Returns the plan of a film: the steps that are left to do.
FarmPlan farm_plan(const FarmOptions& options, const FarmFilm& film);

}  // namespace ergodome
