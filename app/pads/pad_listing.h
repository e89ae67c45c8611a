#pragma once

#include <filesystem>

#include "app/pads/hid/hid_api.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

//! Prints the controllers that are there, with what reads each, or why nothing does, and which settings are its own; `file` is where these were read from,
//! empty where there is none.
void list_pads(HidApi& api, const PadSettings& settings, const std::filesystem::path& file);

//! Adds settings for each controller that has none, and writes all. Throws Error where the file cannot be written.
void write_pads_found(HidApi& api, PadSettings settings, const std::filesystem::path& out);

}  // namespace ergodome
