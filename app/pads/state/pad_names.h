#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/pads/state/pad_state.h"

namespace ergodome {

// Return the names of axes and buttons in settings files and on the terminal, as in the enums.
std::string_view name_of(PadAxis axis);
std::string_view name_of(PadButton button);

//! pad_axis_named() and pad_button_named() return the axis or button with a name; nothing if there
//! is none.
std::optional<PadAxis> pad_axis_named(std::string_view name);
std::optional<PadButton> pad_button_named(std::string_view name);

//! pad_axis_names() and pad_button_names() return all names, for messages that suggest one.
std::vector<std::string> pad_axis_names();
std::vector<std::string> pad_button_names();

//! Returns whether some controller has a raw axis with this name: of a stick or trigger ("left_x",
//! "simple_left_x"), of a 3D mouse ("pitch"), or its HID usage ("rz", or "slider_2" if there are
//! several).
bool is_raw_axis_name(std::string_view name);
//! Returns all names of raw axes, without the numbered ones ("slider_2").
std::vector<std::string> raw_axis_names();

//! Returns whether an axis goes from 0 to 1 and rests at 0.
constexpr bool is_trigger(PadAxis axis) { return axis == PadAxis::left_trigger || axis == PadAxis::right_trigger; }

}  // namespace ergodome
