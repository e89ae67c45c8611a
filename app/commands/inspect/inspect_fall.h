#pragma once

#include <nlohmann/json.hpp>

#include "content/show/show.h"

namespace ergodome {

//! Returns the summary of the free fall of a show's camera until it or the show ends: smallest
//! radius, turns around the hole, turning points, the crossing of the horizon, and the show time
//! `stop_s` at which the fall stops. The show must have a fall.
nlohmann::json summary_of_fall(const Show& show);

//! Prints the summary that summary_of_fall() returns.
void print_fall(const nlohmann::json& summary);

}  // namespace ergodome
