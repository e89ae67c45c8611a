#include "calibration/pad_names.h"

#include <algorithm>

namespace ergodome {

namespace {

constexpr std::array<std::string_view, pad_axis_count> axis_names = {
    "left_x",     "left_y",  "right_x",      "right_y",    "left_trigger", "right_trigger",
    "move_right", "move_up", "move_forward", "turn_pitch", "turn_yaw",     "turn_roll"};

constexpr std::array<std::string_view, pad_button_count> button_names = {
    "south",      "east",    "west",  "north",      "left_shoulder", "right_shoulder", "left_trigger", "right_trigger",
    "select",     "start",   "guide", "left_stick", "right_stick",   "dpad_up",        "dpad_down",    "dpad_left",
    "dpad_right", "capture", "touch", "paddle_1",   "paddle_2",      "paddle_3",       "paddle_4"};

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

std::vector<std::string> pad_axis_names() { return {axis_names.begin(), axis_names.end()}; }

std::vector<std::string> pad_button_names() { return {button_names.begin(), button_names.end()}; }

}  // namespace ergodome
