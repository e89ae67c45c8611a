#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads the table [effects] of a show file. Throws Error with file, line and key for invalid
//! values.
void read_effects(const toml::table& table, const std::string& file, EffectSettings& effects);

//! Reads the table [tone] in the same way.
void read_tone(const toml::table& table, const std::string& file, ToneSettings& tone);

}  // namespace ergodome
