#include "app/pads/pad_settings.h"

#include <fmt/format.h>

#include <cstdlib>

#include "app/pads/state/pad_names.h"
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

constexpr std::string_view head =
    R"(# Settings of game controllers. A [[pad]] table applies to controllers whose device, name and serial match the output of `ergodome pad`.
# Keys that it omits are taken from [default]. If several tables match, a serial ranks before a device, and a device before a name.

)";

constexpr std::string_view profile_help =
    R"(# ignore: true disables the controller. mode_switch: requests full reports (DualShock and DualSense over Bluetooth, Switch Pro);
# leave it false if the kernel driver already does this.
# dead_zone: deflections below this fraction of the full range count as 0 (radial for sticks). full_at: deflections from here on count as 1.
# exponent: values above 1 give finer control near the center. expo: 0 to 1, share of a cubic curve.
# invert: axes to reverse, for example ["left_y", "right_y"].
# [axes]: assigns raw axes, for example rz = "-right_y" (minus: reversed) or slider = "none".
# buttons: assigns HID buttons 1, 2, ..., for example ["south", "east", "none"]; only for controllers read by their report descriptor.
# [calibration]: minimum, center and maximum of each raw axis, as measured by `ergodome pad --calibrate`.
)";

//! Returns a text or a key in TOML quotes.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string list_of(const std::vector<std::string_view>& names) {
  std::string list = "[";
  for (std::size_t i = 0; i < names.size(); ++i) {
    fmt::format_to(std::back_inserter(list), "{}\"{}\"", i > 0 ? ", " : "", names[i]);
  }
  return list + "]";
}

std::string curve_of(const PadCurve& curve) {
  return fmt::format("{{ dead_zone = {}, full_at = {}, exponent = {}, expo = {} }}", curve.dead_zone, curve.full_at,
                     curve.exponent, curve.expo);
}

std::string inverted_of(const PadProfile& profile) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < pad_axis_count; ++i) {
    if (profile.inverted[i]) {
      names.push_back(name_of(static_cast<PadAxis>(i)));
    }
  }
  return list_of(names);
}

std::string buttons_of(const PadProfile& profile) {
  std::vector<std::string_view> names;
  names.reserve(profile.buttons.size());
  for (const auto& button : profile.buttons) {
    names.push_back(button ? name_of(*button) : "none");
  }
  return list_of(names);
}

//! Returns the keys of a profile; `table` is the prefix of its subtables, "default" or "pad".
std::string body_of(const PadProfile& profile, std::string_view table) {
  std::string text = fmt::format("ignore = {}\nmode_switch = {}\n", profile.ignore, profile.mode_switch);
  fmt::format_to(std::back_inserter(text), "left_stick = {}\nright_stick = {}\ntriggers = {}\npuck = {}\n",
                 curve_of(profile.left_stick), curve_of(profile.right_stick), curve_of(profile.triggers),
                 curve_of(profile.puck));
  fmt::format_to(std::back_inserter(text), "invert = {}\nbuttons = {}\n", inverted_of(profile), buttons_of(profile));
  fmt::format_to(std::back_inserter(text), "[{}.axes]\n", table);
  for (const auto& [name, target] : profile.axes) {
    fmt::format_to(std::back_inserter(text), "{} = \"{}{}\"\n", in_quotes(name), target.inverted ? "-" : "",
                   target.axis ? name_of(*target.axis) : "none");
  }
  fmt::format_to(std::back_inserter(text), "[{}.calibration]\n", table);
  for (const auto& [name, range] : profile.calibration) {
    fmt::format_to(std::back_inserter(text), "{} = [{}, {}, {}]\n", in_quotes(name), range.minimum, range.centre,
                   range.maximum);
  }
  return text;
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

std::string to_toml(const PadSettings& settings) {
  std::string text(head);
  text +=
      "# A deflected stick whose value stays exactly the same for this many seconds is ignored until it moves; 0 turns "
      "this off.\n";
  fmt::format_to(std::back_inserter(text), "stuck_after_s = {}\n\n", settings.stuck_after_s);
  text += profile_help;
  text += "[default]\n" + body_of(settings.otherwise, "default");
  for (const PadProfile& profile : settings.pads) {
    text += "\n[[pad]]\n";
    if (!profile.device.empty()) {
      text += "device = " + in_quotes(profile.device) + "\n";
    }
    if (!profile.name.empty()) {
      text += "name = " + in_quotes(profile.name) + "\n";
    }
    if (!profile.serial.empty()) {
      text += "serial = " + in_quotes(profile.serial) + "\n";
    }
    text += body_of(profile, "pad");
  }
  return text;
}

}  // namespace ergodome
