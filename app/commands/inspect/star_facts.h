#pragma once

#include <nlohmann/json.hpp>

#include "app/commands/inspect/show_notes.h"

namespace ergodome {

//! Returns how many stars a show's catalogue has, which columns were read, and which rows were left out.
nlohmann::json facts_of_stars(const Show& show, const ShowNotes& notes);

void print_stars(const nlohmann::json& facts);

}  // namespace ergodome
