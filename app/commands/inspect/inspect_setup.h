#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ergodome {

//! Whether a file is a dome setup: TOML with a table [dome] or a [[projector]], which no show has.
bool is_dome_setup(const std::string& file);

//! Reads a setup with all the files that it names, and tells what is in it. Where `picture` names a PNG, draws it (render/patterns/
//! setup_picture.h), `size_px` wide.
nlohmann::json inspect_setup(const std::string& file, const std::string& picture, int size_px);

//! What is to be said of a projector that stands outside the dome's sphere, after its name.
inline constexpr const char* outside_note =
    " is outside the dome's sphere: only light that enters below the rim reaches the dome";

//! Prints those facts for people.
void print_setup(const nlohmann::json& facts);

}  // namespace ergodome
