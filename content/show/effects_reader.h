#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads the table [effects] of a show's file. Throws Error with file, line and key for what cannot be.
void read_effects(const toml::table& table, const std::string& file, EffectSettings& effects);

//! The same for [tone].
void read_tone(const toml::table& table, const std::string& file, ToneSettings& tone);

}  // namespace ergodome
