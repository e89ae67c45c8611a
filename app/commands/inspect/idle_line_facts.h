#pragma once

#include <nlohmann/json_fwd.hpp>

#include "content/show/show.h"

namespace ergodome {

//! Returns the unused keys of a show as a list (content/show/idle_lines.h).
nlohmann::json facts_of_idle_lines(const Show& show);

//! Prints a list of unused keys; nothing if it is empty.
void print_idle_lines(const nlohmann::json& lines);

}  // namespace ergodome
