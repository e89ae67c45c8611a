#pragma once

#include <nlohmann/json.hpp>

#include "content/show/show.h"

namespace ergodome {

//! Where a show's fall leads its camera, until it ends or the show does: how near to the hole, how often round it, where the orbit turns and when, and
//! when time comes to rest. The show has one.
nlohmann::json facts_of_fall(const Show& show);

//! Prints those facts.
void print_fall(const nlohmann::json& facts);

}  // namespace ergodome
