#pragma once

#include <filesystem>
#include <string>

#include "app/pads/hid/hid_api.h"
#include "app/pads/pad_hub.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

//! Prints the connected controllers, each with its decoder, or why it cannot be used, and its
//! settings; `file` is the settings file, empty if there is none.
void list_pads(HidApi& api, const PadSettings& settings, const std::filesystem::path& file);

//! Adds settings for each controller that has none, and writes the file. Throws Error if it cannot
//! be written.
void write_pads_found(HidApi& api, PadSettings settings, const std::filesystem::path& out);

//! Formats a controller's live values on a line: "1 Wireless Controller (USB): left -0.12 +0.98
//! right +0.00 +0.00  triggers 0.00 0.50  south".
std::string live_line(const PadView& pad);

}  // namespace ergodome
