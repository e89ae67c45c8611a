#pragma once

#include <optional>
#include <vector>

#include "app/pads/hid/hid_descriptor.h"
#include "app/pads/state/pad_state.h"

namespace ergodome {

//! has_pad() returns whether any application collection of a HID device is a joystick (usage 1:4),
//! a game pad (1:5) or a multi-axis controller (1:8); is_pad_usage() returns whether a usage is one
//! of these.
bool has_pad(const HidLayout& hid);
bool is_pad_usage(const HidUsage& usage);

//! Returns whether any application collection of a HID device is a multi-axis controller (usage
//! 1:8), such as a 3D mouse.
bool is_puck(const HidLayout& hid);

//! Returns the name of an axis: "x" to "rz", "slider", "dial", "wheel", "throttle", "brake", and so
//! on. Returns nullptr if the usage is not an axis of a controller.
const char* generic_axis_name(const HidUsage& usage);

//! Returns the button with a specific usage: the four of a directional pad, and those of
//! Microsoft's controllers on the consumer page; nothing for other usages.
std::optional<PadButton> generic_button(const HidUsage& usage);

//! Maps raw axes by their names (generic_axis_name()) and ranges: two sticks and the triggers of a
//! game pad; x, y and twist of a flight stick, without its throttle, which rests anywhere; the six
//! axes of a 3D mouse.
void map_generic_axes(const HidLayout& hid, std::vector<RawAxis>& axes);

//! Returns the meaning of HID buttons 1 to `count`: for 3D mice, in the order of space_mouse.cpp.
//! For game pads with at least 15 buttons and pedals as triggers, in the order of Android and
//! Linux. Otherwise in Logitech's.
std::vector<std::optional<PadButton>> generic_buttons(const HidLayout& hid, std::size_t count);

}  // namespace ergodome
