#include <fmt/format.h>

#include "app/pads/pad_names.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

namespace {

constexpr std::string_view head =
    R"(# How controllers are read. A [[pad]] is about those whose device, name and serial agree with what `ergodome pad` lists; what it
# leaves out is as in [default]. Of several that agree, one with a serial is taken before one with a device, and that before a name.

)";

constexpr std::string_view profile_help =
    R"(# ignore: leaves the controller alone. mode_switch: asks it for its full reports (DualShock and DualSense over Bluetooth, Switch Pro);
# leave it false where the kernel's driver does that.
# dead_zone: nothing below (a part of the whole deflection; of sticks radial). full_at: all from there on.
# exponent: above 1, finer about the middle. expo: from 0 to 1, blends a cube in.
# invert: axes that go the wrong way, as in ["left_y", "right_y"].
# [axes]: what a raw axis moves, as in rz = "-right_y" (minus: inverted) or slider = "none".
# buttons: what HID button 1, 2, ... is, as in ["south", "east", "none"]; of controllers read by their descriptor.
# [calibration]: least, centre, greatest of a raw axis; `ergodome pad --calibrate` measures them.
)";

//! A text, or a key, in TOML's quotes.
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

//! The keys of a profile; `table` is what its subtables begin with, "default" or "pad".
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
    fmt::format_to(std::back_inserter(text), "{} = [{}, {}, {}]\n", in_quotes(name), range.least, range.centre,
                   range.greatest);
  }
  return text;
}

}  // namespace

std::string to_toml(const PadSettings& settings) {
  std::string text(head);
  text +=
      "# A stick that is deflected and counts exactly the same for so many seconds is left out until it moves; 0: "
      "never.\n";
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
