#include "app/pads/state/pad_names.h"

#include <algorithm>
#include <charconv>

#include "app/pads/state/pad_state.h"

namespace ergodome {

namespace {

constexpr std::array<std::string_view, pad_axis_count> axis_names = {
    "left_x",     "left_y",  "right_x",      "right_y",    "left_trigger", "right_trigger",
    "move_right", "move_up", "move_forward", "turn_pitch", "turn_yaw",     "turn_roll"};

constexpr std::array<std::string_view, pad_button_count> button_names = {
    "south",      "east",    "west",  "north",      "left_shoulder", "right_shoulder", "left_trigger", "right_trigger",
    "select",     "start",   "guide", "left_stick", "right_stick",   "dpad_up",        "dpad_down",    "dpad_left",
    "dpad_right", "capture", "touch", "paddle_1",   "paddle_2",      "paddle_3",       "paddle_4"};

// Names of raw axes that the decoders in app/pads/decoders use.
constexpr std::array<std::string_view, 13> known_raw_axes = {"left_x",
                                                             "left_y",
                                                             "right_x",
                                                             "right_y",
                                                             "left_trigger",
                                                             "right_trigger",
                                                             "simple_left_x",
                                                             "simple_left_y",
                                                             "simple_right_x",
                                                             "simple_right_y",
                                                             "pitch",
                                                             "roll",
                                                             "yaw"};
constexpr std::array<std::string_view, 15> usage_raw_axes = {"x",        "y",           "z",     "rx",     "ry",
                                                             "rz",       "slider",      "dial",  "wheel",  "rudder",
                                                             "throttle", "accelerator", "brake", "clutch", "steering"};

//! Returns "slider" for "slider_2"; the whole name if it does not end in a number that a raw axis
//! can have.
std::string_view without_number(std::string_view name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos || name.substr(bar + 1).starts_with('0')) {
    return name;
  }
  std::size_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, problem] = std::from_chars(name.data() + bar + 1, end, number);
  const bool fits = problem == std::errc{} && stop == end && number >= 2 && number <= max_raw_axes;
  return fits ? name.substr(0, bar) : name;
}

template <class Value, std::size_t count>
std::optional<Value> named(const std::array<std::string_view, count>& names, std::string_view name) {
  const auto* const found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<Value>(found - names.begin());
}

}  // namespace

std::string_view name_of(PadAxis axis) { return axis_names[static_cast<std::size_t>(axis)]; }

std::string_view name_of(PadButton button) { return button_names[static_cast<std::size_t>(button)]; }

std::optional<PadAxis> pad_axis_named(std::string_view name) { return named<PadAxis>(axis_names, name); }

std::optional<PadButton> pad_button_named(std::string_view name) { return named<PadButton>(button_names, name); }

bool is_raw_axis_name(std::string_view name) {
  return std::ranges::find(known_raw_axes, name) != known_raw_axes.end() ||
         std::ranges::find(usage_raw_axes, without_number(name)) != usage_raw_axes.end();
}

std::vector<std::string> raw_axis_names() {
  std::vector<std::string> names(known_raw_axes.begin(), known_raw_axes.end());
  names.insert(names.end(), usage_raw_axes.begin(), usage_raw_axes.end());
  return names;
}

std::vector<std::string> pad_axis_names() { return {axis_names.begin(), axis_names.end()}; }

std::vector<std::string> pad_button_names() { return {button_names.begin(), button_names.end()}; }

}  // namespace ergodome
