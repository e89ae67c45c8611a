#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ergodome {

//! Returns whether a file is a dome setup: TOML with a table [dome] or a [[projector]], which no
//! show has.
bool is_dome_setup(const std::string& file);

//! Reads a setup with all files that it names and returns a summary. If `picture` names a PNG,
//! draws it `size_px` wide (render/patterns/setup_picture.h).
nlohmann::json inspect_setup(const std::string& file, const std::string& picture, int size_px);

//! Note on a projector outside the dome's sphere; follows its name.
inline constexpr const char* outside_note =
    " is outside the dome's sphere: only light that enters below the rim reaches the dome";

//! Prints the summary that inspect_setup() returns.
void print_setup(const nlohmann::json& summary);

}  // namespace ergodome
