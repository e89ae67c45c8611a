#pragma once

#include <optional>
#include <vector>

#include "app/pads/hid/hid_descriptor.h"
#include "app/pads/pad_raw.h"

namespace ergodome {

//! Whether one of the applications is a joystick (1:4), a game pad (1:5) or a multi-axis controller (1:8).
bool has_pad(const HidLayout& hid);
bool is_pad_usage(const HidUsage& usage);

//! Whether one of the applications is a multi-axis controller (1:8), such as a 3D mouse.
bool is_puck(const HidLayout& hid);

//! "x" to "rz", "slider", "dial", "wheel", "throttle", "brake", ...; nullptr where a usage is no axis of a pad.
const char* generic_axis_name(const HidUsage& usage);

//! Buttons that have a usage of their own: the four of a directional pad, and those of Microsoft's pads on the consumer page.
std::optional<PadButton> generic_button(const HidUsage& usage);

//! Says what raw axes move, by the names above and their ranges: two sticks and triggers of a pad; of a flight stick x, y and the twist,
//! because its throttle rests anywhere; the six of a puck.
void map_generic_axes(const HidLayout& hid, std::vector<RawAxis>& axes);

//! What HID button 1, 2, ... is: game pads of 15 and more with pedals for triggers count as Android and Linux do, others as Logitech's.
std::vector<std::optional<PadButton>> generic_buttons(const HidLayout& hid, std::size_t count);

}  // namespace ergodome
