#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/navigation/controls/controls.h"

namespace ergodome {

//! Splits a text at blanks.
std::vector<std::string> words_of(std::string_view text);

//! Parses a steering input with an optional minus sign, or a factor from -100 to 100 except 0: "D",
//! "-A", "0.5*pad.left_x". Returns nothing for other text.
std::optional<Controls::SteerBinding> steer_binding_of(std::string_view text);

//! Formats a binding as steer_binding_of() reads it.
std::string text_of(const Controls::SteerBinding& binding);

}  // namespace ergodome
