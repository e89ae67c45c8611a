#pragma once

#include <nlohmann/json.hpp>

#include "content/show.h"

namespace ergodome {

//! The files that a show names, and what it does with time: numbers that change, chapters, captions, overlays and audio tracks, in which languages, and whether the
//! files that they name are there.
nlohmann::json facts_of_timeline(const Show& show);

//! Prints those facts; nothing for a show that has none.
void print_timeline(const nlohmann::json& facts);

}  // namespace ergodome
