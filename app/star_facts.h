#pragma once

#include <nlohmann/json.hpp>

#include "app/show_notes.h"

namespace ergodome {

//! How many stars a show's catalogue has, and which rows of it were left out.
nlohmann::json facts_of_stars(const Show& show, const ShowNotes& notes);

void print_stars(const nlohmann::json& facts);

}  // namespace ergodome
