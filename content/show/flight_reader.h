#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/flight_settings.h"

namespace ergodome {

//! Reads [flight]: how visitors may fly.
void read_flight(const toml::table& table, const std::string& file, FlightSettings& flight);

//! The same as a table that reads back.
toml::table flight_table(const FlightSettings& flight);

}  // namespace ergodome
