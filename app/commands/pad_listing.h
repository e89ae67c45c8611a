#pragma once

#include <filesystem>

#include "app/pads/hid/hid_api.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

//! Prints each connected controller with its decoder, or why it cannot be used, and with the table
//! of `settings` that applies to it. Then prints `file`, the path of the settings, which is empty
//! if there is no such file.
void list_pads(HidApi& api, const PadSettings& settings, const std::filesystem::path& file);

//! Adds a copy of the default settings for each connected controller that has none of its own, and
//! writes all settings to a file. Throws Error if it cannot be written.
void write_pads_found(HidApi& api, PadSettings settings, const std::filesystem::path& out);

}  // namespace ergodome
