#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! The operator's settings that survive a restart.
struct SavedSettings {
  double exposure_stops = 0.0;
  double baseline = -1.0;  //!< baseline [M]; below 0: the show's
  double volume = 1.0;
  std::string language;
  bool captions = true;

  bool operator==(const SavedSettings&) const = default;
};

//! Returns the folder for settings and the log: $XDG_STATE_HOME/ergodome if that variable is an
//! absolute path, or ~/.local/state/ergodome. Empty if the user has no home folder.
std::filesystem::path state_folder();

//! Reads settings. A missing file gives the defaults. So does a damaged file, which is renamed to
//! NAME.bad, so that an exhibit always starts; `problem` then gives the reason, and is otherwise
//! empty.
SavedSettings read_saved_settings(const std::filesystem::path& file, std::string& problem);

//! Writes settings atomically, and creates their folder. Throws Error if that fails.
void write_saved_settings(const std::filesystem::path& file, const SavedSettings& settings);

}  // namespace ergodome
