#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/commands/farm/farm_plan.h"

namespace ergodome {

//! Files of a run by name: scripts, lists of tasks, and a job template.
using RunFiles = std::map<std::string, std::string>;

//! The state of a film that is made by a farm, in a folder of its own beside the frames. It consists
//! of files only, which machines share through the file system.
class FarmFolder {
 public:
  //! `out` is the folder of the frames. Creates nothing.
  explicit FarmFolder(const std::filesystem::path& out);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  //! Returns the folder of the light that automatic exposure follows.
  [[nodiscard]] std::filesystem::path light() const { return path_ / "light"; }

  //! Returns the number of the newest run; 0 if there is none.
  [[nodiscard]] int newest_run() const;
  [[nodiscard]] std::filesystem::path run_folder(int run) const;
  //! Creates the folder of a run and writes its files and its plan. Throws Error if that fails.
  void write_run(int run, const std::string& engine, const FarmPlan& plan, const RunFiles& files) const;

 private:
  std::filesystem::path path_;
};

//! What a run does, as its folder describes it.
struct FarmRun {
  int number = 0;
  std::filesystem::path folder;
  std::string engine;
  FarmPlan plan;  //!< without words and program
};

//! Reads the newest run of the film in a folder. Throws Error if the folder has no run, or if its
//! description is malformed.
FarmRun newest_farm_run(const std::filesystem::path& out);

//! Choices of a film that were made from measured times and must stay the same in later runs.
struct FilmChoices {
  std::string request;  //!< fingerprint of the film's first frame
  int chunk = 0;
  std::vector<std::string> quality;  //!< options that replace --budget
};

//! Returns the stored choices of a film, or nothing for another fingerprint.
std::optional<FilmChoices> stored_choices(const FarmFolder& folder, const std::string& request);
void store_choices(const FarmFolder& folder, const FilmChoices& choices);

}  // namespace ergodome
