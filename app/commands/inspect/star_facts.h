#pragma once

#include <nlohmann/json.hpp>

#include "app/commands/inspect/show_notes.h"

namespace ergodome {

//! Returns the number of stars in a show's catalogue, the columns read, and the rows left out.
nlohmann::json facts_of_stars(const Show& show, const ShowNotes& notes);

void print_stars(const nlohmann::json& facts);

}  // namespace ergodome
