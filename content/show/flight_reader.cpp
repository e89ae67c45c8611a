#include "content/show/flight_reader.h"

#include <fmt/format.h>

#include "content/files/toml_table.h"

namespace ergodome {

namespace {

ComfortSettings read_comfort(const toml::table& table, const std::string& file) {
  TomlTable reader(table, file, "flight.comfort");
  ComfortSettings comfort;
  comfort.turn_deg_s = reader.number("turn_deg_s", comfort.turn_deg_s, 0.1, 720.0);
  comfort.turn_accel_deg_s2 = reader.number("turn_accel_deg_s2", comfort.turn_accel_deg_s2, 0.1, 7200.0);
  comfort.accel = reader.number("accel", comfort.accel, 0.01, 100.0);
  reader.refuse_unknown_keys();
  return comfort;
}

}  // namespace

void read_flight(const toml::table& table, const std::string& file, FlightSettings& flight) {
  TomlTable reader(table, file, "flight");
  flight.guard = static_cast<FlightGuard>(reader.choice("guard", 0, {"horizon", "photon_orbit"}));
  flight.mode = static_cast<FlightMode>(reader.choice("mode", 0, {"orbit", "fly", "hover", "geodesic"}));
  flight.from = static_cast<FlightStart>(reader.choice("from", 0, {"path", "first_key"}));
  flight.max_speed = reader.number("max_speed", flight.max_speed, 0.001, 10.0);
  flight.least_r = reader.number("least_r", flight.least_r, 0.0, 1e8);
  flight.most_r = reader.number("most_r", flight.most_r, 5.0, 1e9);
  flight.return_s = reader.number("return_s", flight.return_s, 0.5, 60.0);
  if (!(flight.least_r <= 0.9 * flight.most_r)) {
    throw reader.error_at("least_r", fmt::format("is {}, too close to most_r", flight.least_r),
                          fmt::format("choose at most {:.6g}", 0.9 * flight.most_r));
  }
  if (const toml::table* comfort = reader.table("comfort")) {
    flight.comfort = read_comfort(*comfort, file);
  }
  reader.refuse_unknown_keys();
}

toml::table flight_table(const FlightSettings& flight) {
  constexpr const char* guards[] = {"horizon", "photon_orbit"};
  constexpr const char* starts[] = {"path", "first_key"};
  return toml::table{{"guard", guards[static_cast<std::size_t>(flight.guard)]},
                     {"mode", flight_mode_names[static_cast<std::size_t>(flight.mode)]},
                     {"from", starts[static_cast<std::size_t>(flight.from)]},
                     {"max_speed", flight.max_speed},
                     {"least_r", flight.least_r},
                     {"most_r", flight.most_r},
                     {"return_s", flight.return_s},
                     {"comfort", toml::table{{"turn_deg_s", flight.comfort.turn_deg_s},
                                             {"turn_accel_deg_s2", flight.comfort.turn_accel_deg_s2},
                                             {"accel", flight.comfort.accel}}}};
}

}  // namespace ergodome
