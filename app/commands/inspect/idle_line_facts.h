#pragma once

#include <nlohmann/json_fwd.hpp>

#include "content/show/show.h"

namespace ergodome {

//! The lines of a show that change nothing, as a list (content/idle_lines.h).
nlohmann::json facts_of_idle_lines(const Show& show);

//! Prints such a list for a person; nothing where it is empty.
void print_idle_lines(const nlohmann::json& lines);

}  // namespace ergodome
