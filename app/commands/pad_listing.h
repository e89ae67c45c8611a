#pragma once

#include <filesystem>

#include "app/pads/hid/hid_api.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

//! Prints the connected controllers, each with its decoder, or why it cannot be used, and its
//! settings; `file` is the settings file, empty if there is none.
void list_pads(HidApi& api, const PadSettings& settings, const std::filesystem::path& file);

//! Adds settings for each controller that has none, and writes the file. Throws Error if it cannot
//! be written.
void write_pads_found(HidApi& api, PadSettings settings, const std::filesystem::path& out);

}  // namespace ergodome
