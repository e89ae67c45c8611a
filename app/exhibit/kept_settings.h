#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! What an operator turned and wants to find again after a restart.
struct KeptSettings {
  double exposure_stops = 0.0;
  double baseline = -1.0;  //!< [M]; below 0: the show's
  double volume = 1.0;
  std::string language;
  bool captions = true;

  bool operator==(const KeptSettings&) const = default;
};

//! Returns the folder for settings and the log: $XDG_STATE_HOME/ergodome, or ~/.local/state/ergodome. Empty where the user
//! has no home.
std::filesystem::path state_folder();

//! Reads settings. A file that is not there gives the usual ones. One that is damaged does, too, is renamed to NAME.bad for whoever wants to
//! look at it, and `problem` says so: an exhibit must start.
KeptSettings read_kept_settings(const std::filesystem::path& file, std::string& problem);

//! Writes settings whole or not at all. Throws Error where the disk refuses.
void write_kept_settings(const std::filesystem::path& file, const KeptSettings& settings);

}  // namespace ergodome
