#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/pads/pad_state.h"

namespace ergodome {

//! Response curve of a stick, trigger or puck: 0 up to `dead_zone`, then rising without a step,
//! 1 from `full_at` on. With t from 0 to 1 between the two: s = t^exponent, then (1 - expo) s + expo s^3.
struct PadCurve {
  double dead_zone = 0.0;  //!< of the full deflection; of sticks and pucks radial, so that directions stay
  double full_at = 1.0;
  double exponent = 1.0;
  double expo = 0.0;

  bool operator==(const PadCurve&) const = default;
};

//! Raw values of an axis at its ends and at rest.
struct AxisCalibration {
  std::int32_t least = 0;
  std::int32_t centre = 0;
  std::int32_t greatest = 0;

  bool operator==(const AxisCalibration&) const = default;
};

//! The axis that a raw axis controls instead of its default.
struct AxisTarget {
  std::optional<PadAxis> axis;  //!< nothing: it moves nothing
  bool inverted = false;

  bool operator==(const AxisTarget&) const = default;
};

//! Identity of a controller.
struct PadIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string name;
  std::string serial;      //!< empty where it has none
  std::string connection;  //!< "USB", "Bluetooth" or "other"
  std::string path;        //!< where the system has it, as /dev/hidraw3
  std::string model;       //!< which decoder reads it: "DualSense"

  bool operator==(const PadIdentity&) const = default;
};

//! Settings of one controller or of all controllers of a kind.
struct PadProfile {
  std::string device;  //!< "054c:0ce6", vendor and product in lower-case hex; empty: any
  std::string name;    //!< name reported by the controller; empty: any
  std::string serial;  //!< empty: any
  bool ignore = false;
  bool mode_switch = false;  //!< ask for full reports, once; leave it to the kernel's driver where there is one
  PadCurve left_stick{.dead_zone = 0.15, .full_at = 0.98, .exponent = 1.5};
  PadCurve right_stick{.dead_zone = 0.15, .full_at = 0.98, .exponent = 1.5};
  PadCurve triggers{.dead_zone = 0.05, .full_at = 0.98};
  PadCurve puck{.dead_zone = 0.05, .full_at = 1.0, .exponent = 1.5};
  std::bitset<pad_axis_count> inverted;                 //!< on top of everything else
  std::map<std::string, AxisTarget, std::less<>> axes;  //!< by the raw axis' name
  std::vector<std::optional<PadButton>> buttons;        //!< HID button 1, 2, ...; empty: by default
  std::map<std::string, AxisCalibration, std::less<>> calibration;

  bool operator==(const PadProfile&) const = default;
};

//! The file pads.toml.
struct PadSettings {
  double stuck_after_s =
      120.0;  //!< a stick that is deflected and counts exactly the same for so long is left out until it moves; 0: never
  PadProfile otherwise;  //!< table [default]: for controllers that no [[pad]] is about, and what a [[pad]] starts from
  std::vector<PadProfile> pads;

  bool operator==(const PadSettings&) const = default;
};

//! Reads settings. Throws Error with file and line; an unknown key is an error that names the nearest.
PadSettings parse_pad_settings(std::string_view text, const std::string& file);

//! Reads a settings file. Throws Error.
PadSettings load_pad_settings(const std::filesystem::path& path);

//! Returns the settings as the text of a file, with comments.
std::string to_toml(const PadSettings& settings);

//! Writes a settings file, atomically; an older one is kept as NAME.bak. Makes its folder. Throws Error.
void write_pad_settings(const std::filesystem::path& path, const PadSettings& settings);

//! $XDG_CONFIG_HOME/ergodome/pads.toml, or below ~/.config; empty where there is neither.
std::filesystem::path default_pad_settings_path();

//! Returns the profile of a controller: one with its serial, else its device, else its name, else `otherwise`.
const PadProfile& profile_for(const PadSettings& settings, const PadIdentity& pad);

//! "054c:0ce6".
std::string device_id(std::uint16_t vendor, std::uint16_t product);

}  // namespace ergodome
