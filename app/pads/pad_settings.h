#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/pads/state/pad_state.h"

namespace ergodome {

//! Response curve of a stick, trigger or 3D mouse: 0 up to `dead_zone`, then rising continuously, 1
//! from `full_at` on.
//! With t from 0 to 1 between the two: s = t^exponent, then (1 - expo) s + expo s^3.
struct PadCurve {
  //! Dead zone as a fraction of full deflection. It is radial for sticks and 3D mice, so that it
  //! does not change the direction.
  double dead_zone = 0.0;
  double full_at = 1.0;
  double exponent = 1.0;
  double expo = 0.0;

  bool operator==(const PadCurve&) const = default;
};

//! Raw values of an axis at its ends and at rest.
struct AxisCalibration {
  std::int32_t minimum = 0;
  std::int32_t centre = 0;
  std::int32_t maximum = 0;

  bool operator==(const AxisCalibration&) const = default;
};

//! The axis that a raw axis controls instead of its default.
struct AxisTarget {
  std::optional<PadAxis> axis;  //!< the axis to control; nothing: the raw axis is disabled
  bool inverted = false;

  bool operator==(const AxisTarget&) const = default;
};

//! Identity of a controller.
struct PadIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string name;
  std::string serial;      //!< serial number; empty if the controller has none
  std::string connection;  //!< "USB", "Bluetooth" or "other"
  std::string path;        //!< system path, such as /dev/hidraw3
  std::string model;       //!< model of its decoder: "DualSense"

  bool operator==(const PadIdentity&) const = default;
};

//! Settings of one controller or of all controllers of a kind.
struct PadProfile {
  std::string device;  //!< "054c:0ce6", vendor and product in lower-case hex; empty: any
  std::string name;    //!< name reported by the controller; empty: any
  std::string serial;  //!< serial number of the controller; empty: any
  bool ignore = false;
  //! Whether to request full reports when the controller is opened. Keep it false if the kernel has
  //! a driver for the controller, which requests them itself.
  bool mode_switch = false;
  PadCurve left_stick{.dead_zone = 0.15, .full_at = 0.98, .exponent = 1.5};
  PadCurve right_stick{.dead_zone = 0.15, .full_at = 0.98, .exponent = 1.5};
  PadCurve triggers{.dead_zone = 0.05, .full_at = 0.98};
  PadCurve puck{.dead_zone = 0.05, .full_at = 1.0, .exponent = 1.5};
  std::bitset<pad_axis_count> inverted;                 //!< inverts mapped axes, before their curves
  std::map<std::string, AxisTarget, std::less<>> axes;  //!< by the name of the raw axis
  std::vector<std::optional<PadButton>> buttons;        //!< HID buttons 1, 2, ...; empty: default
  std::map<std::string, AxisCalibration, std::less<>> calibration;

  bool operator==(const PadProfile&) const = default;
};

//! Contents of the settings file pads.toml.
struct PadSettings {
  //! An axis that is deflected with an exactly constant value for this long is ignored until it
  //! moves; 0: never.
  double stuck_after_s = 120.0;
  //! Table [default]: for controllers without a [[pad]], and the base of each [[pad]].
  PadProfile otherwise;
  std::vector<PadProfile> pads;

  bool operator==(const PadSettings&) const = default;
};

//! Parses settings. Throws Error with file and line; for an unknown key it suggests the nearest
//! one.
PadSettings parse_pad_settings(std::string_view text, const std::string& file);

//! Reads a settings file. Throws Error if it is missing or invalid.
PadSettings load_pad_settings(const std::filesystem::path& path);

//! Returns the settings as the text of a file, with comments.
std::string to_toml(const PadSettings& settings);

//! Writes a settings file atomically and creates its folder; keeps an older file as NAME.bak.
//! Throws Error if that fails.
void write_pad_settings(const std::filesystem::path& path, const PadSettings& settings);

//! Returns $XDG_CONFIG_HOME/ergodome/pads.toml, or the same below ~/.config; empty if neither
//! folder is known.
std::filesystem::path default_pad_settings_path();

//! Returns the profile of a controller: one with its serial, else its device, else its name, else
//! `otherwise`.
const PadProfile& profile_for(const PadSettings& settings, const PadIdentity& pad);

//! Formats vendor and product as an id: "054c:0ce6".
std::string device_id(std::uint16_t vendor, std::uint16_t product);

}  // namespace ergodome
