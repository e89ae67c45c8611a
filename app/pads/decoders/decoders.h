#pragma once

#include <memory>
#include <span>

#include "app/pads/decoders/pad_decoder.h"

namespace ergodome {

// Decoders of known controllers. Their layouts are described in their files and in tests/data/hid.
std::unique_ptr<PadDecoder> make_dualshock4(HidBus bus);
std::unique_ptr<PadDecoder> make_dualsense(HidBus bus);
//! `shares`: the controller has a share button in place of view (Series X|S).
std::unique_ptr<PadDecoder> make_xbox_bluetooth(bool shares);
std::unique_ptr<PadDecoder> make_switch_pro(HidBus bus);
std::unique_ptr<PadDecoder> make_logitech_f310();
std::unique_ptr<PadDecoder> make_space_mouse();
//! `otherwise` reads reports that are not in one of the vendor's layouts; may be null.
std::unique_ptr<PadDecoder> make_8bitdo(std::unique_ptr<PadDecoder> otherwise);
//! Makes a decoder from a device's report descriptor. Returns null if that has no axis or button of
//! a controller. Throws Error if it is malformed.
std::unique_ptr<PadDecoder> make_by_descriptor(std::span<const std::uint8_t> descriptor);

}  // namespace ergodome
