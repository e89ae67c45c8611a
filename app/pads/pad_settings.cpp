#include "app/pads/pad_settings.h"

#include <fmt/format.h>

#include <cstdlib>

#include "content/files/atomic_file.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

//! Returns how well a profile fits; 0 if not at all. A serial has priority over a device, and a
//! device over a name.
int fit(const PadProfile& profile, const PadIdentity& pad) {
  if ((!profile.device.empty() && profile.device != device_id(pad.vendor, pad.product)) ||
      (!profile.name.empty() && profile.name != pad.name) ||
      (!profile.serial.empty() && profile.serial != pad.serial)) {
    return 0;
  }
  return (profile.serial.empty() ? 0 : 4) + (profile.device.empty() ? 0 : 2) + (profile.name.empty() ? 0 : 1);
}

std::filesystem::path folder_in_environment(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr ? value : "";
}

}  // namespace

std::string device_id(std::uint16_t vendor, std::uint16_t product) {
  return fmt::format("{:04x}:{:04x}", vendor, product);
}

const PadProfile& profile_for(const PadSettings& settings, const PadIdentity& pad) {
  const PadProfile* best = &settings.otherwise;
  int best_fit = 0;
  for (const PadProfile& profile : settings.pads) {
    if (const int here = fit(profile, pad); here > best_fit) {
      best = &profile;
      best_fit = here;
    }
  }
  return *best;
}

PadSettings load_pad_settings(const std::filesystem::path& path) {
  return parse_pad_settings(read_whole_file(path, std::size_t{1} << 20U, "the pad settings file is a short TOML file"),
                            path.string());
}

void write_pad_settings(const std::filesystem::path& path, const PadSettings& settings) {
  if (path.has_parent_path()) {
    make_folder(path.parent_path());
  }
  keep_older(path);
  write_text_atomically(path, to_toml(settings));
}

std::filesystem::path default_pad_settings_path() {
  std::filesystem::path folder = folder_in_environment("XDG_CONFIG_HOME");
  if (!folder.is_absolute()) {  // relative paths are invalid and ignored (XDG specification)
    folder = folder_in_environment("HOME");
    if (!folder.is_absolute()) {
      return {};
    }
    folder /= ".config";
  }
  return folder / "ergodome" / "pads.toml";
}

}  // namespace ergodome
