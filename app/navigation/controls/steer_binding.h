#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/navigation/controls/controls.h"

namespace ergodome {

//! The words of a text, between blanks.
std::vector<std::string> words_of(std::string_view text);

//! An input that steers, with a sign or a factor up to 100 in front: "D", "-A", "0.5*pad.left_x"; nothing where it is none.
std::optional<Controls::SteerBinding> steer_binding_of(std::string_view text);

//! The same as a text.
std::string text_of(const Controls::SteerBinding& binding);

}  // namespace ergodome
