#pragma once

#include <string>

namespace ergodome {

//! Parses a number of pixels, "0.1px" or "0.1", from 1e-4 to 100. Throws Error, naming the option,
//! for other text.
double pixels_of(const std::string& option, const std::string& text);

}  // namespace ergodome
