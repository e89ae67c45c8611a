#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/pads/pad_state.h"

namespace ergodome {

// What axes and buttons are called in settings files and on the terminal: as in the enums.
std::string_view name_of(PadAxis axis);
std::string_view name_of(PadButton button);

//! The axis or button of that name; nothing where there is none.
std::optional<PadAxis> pad_axis_named(std::string_view name);
std::optional<PadButton> pad_button_named(std::string_view name);

//! All names, for messages that suggest one.
std::vector<std::string> pad_axis_names();
std::vector<std::string> pad_button_names();

//! Whether some controller has a raw axis of that name: a stick's or trigger's ("left_x", "simple_left_x"), a puck's ("pitch"), or by its
//! HID usage ("rz", and "slider_2" where there are several).
bool is_raw_axis_name(std::string_view name);
//! Those names, without the numbered ones.
std::vector<std::string> raw_axis_names();

//! Whether an axis goes from 0 to 1 and rests at 0.
constexpr bool is_trigger(PadAxis axis) { return axis == PadAxis::left_trigger || axis == PadAxis::right_trigger; }

}  // namespace ergodome
