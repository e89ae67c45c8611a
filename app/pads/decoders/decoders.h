#pragma once

#include <memory>
#include <span>

#include "app/pads/pad_decoder.h"

namespace ergodome {

// Decoders of known pads. Layouts: the comments in their files, and tests/data/hid.
std::unique_ptr<PadDecoder> make_dualshock4(HidBus bus);
std::unique_ptr<PadDecoder> make_dualsense(HidBus bus);
//! `shares`: the pad has a share button where others have view (Series X|S).
std::unique_ptr<PadDecoder> make_xbox_bluetooth(bool shares);
std::unique_ptr<PadDecoder> make_switch_pro(HidBus bus);
std::unique_ptr<PadDecoder> make_logitech_f310();
std::unique_ptr<PadDecoder> make_space_mouse();
//! `otherwise` reads what is in none of the vendor's own layouts; may be empty.
std::unique_ptr<PadDecoder> make_8bitdo(std::unique_ptr<PadDecoder> otherwise);
//! Any device by its report descriptor; empty where that has no axis or button of a pad. Throws Error where it is malformed.
std::unique_ptr<PadDecoder> make_by_descriptor(std::span<const std::uint8_t> descriptor);

}  // namespace ergodome
