#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/flight_settings.h"

namespace ergodome {

//! Reads [flight], the settings of free flight.
void read_flight(const toml::table& table, const std::string& file, FlightSettings& flight);

//! Returns free-flight settings as a table that read_flight() accepts.
toml::table flight_table(const FlightSettings& flight);

}  // namespace ergodome
