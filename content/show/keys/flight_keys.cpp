#include <fmt/format.h>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::array guard_names = {"horizon", "photon_orbit"};
constexpr std::array start_names = {"path", "first_key"};

constexpr auto comfort_keys = keys_of<ComfortSettings>(
    key<&ComfortSettings::turn_deg_s>("turn_deg_s", "Fastest turn of the view.").range(0.1, 720.0, "deg/s"),
    key<&ComfortSettings::turn_accel_deg_s2>("turn_accel_deg_s2", "Fastest change of the turning rate.")
        .range(0.1, 7200.0, "deg/s²"),
    key<&ComfortSettings::accel>("accel", "Maximum acceleration, in distances to the guard per second squared.")
        .range(0.01, 100.0, "distances/s²"));

constexpr auto keys_of_flight = keys_of<FlightSettings>(
    key<&FlightSettings::guard>(
        "guard", "The camera stays outside of it. `photon_orbit` means outside every circular orbit of light.")
        .words(guard_names),
    key<&FlightSettings::least_r>("least_r", "A guard farther out. 0: none.")
        .range(0.0, 1e8, "M")
        .page({.bounds = "0 to 1e8, at most 0.9 `most_r`"}),
    key<&FlightSettings::most_r>("most_r", "Maximum radius.")
        .range(5.0, 1e9, "M")
        .after([](TomlTable& table, FlightSettings& flight) {
          if (!(flight.least_r <= 0.9 * flight.most_r)) {
            throw table.error_at("least_r", fmt::format("is {}, too close to most_r", flight.least_r),
                                 fmt::format("choose at most {:.6g}", 0.9 * flight.most_r));
          }
        }),
    key<&FlightSettings::mode>("mode", "How free flight starts.").words(flight_mode_names),
    key<&FlightSettings::from>("from", "Where free flight starts: at the show's camera, or at its first key.")
        .words(start_names),
    key<&FlightSettings::max_speed>("max_speed", "Maximum speed, in distances to the guard per second.")
        .range(0.001, 10.0, "distances/s"),
    key<&FlightSettings::return_s>("return_s",
                                   "Duration of the flight back to the path. It is longer if comfort requires it.")
        .range(0.5, 60.0, "s"),
    table<&FlightSettings::comfort>("comfort", comfort_keys));

}  // namespace

constinit const KeyTable<FlightSettings> flight_keys = keys_of_flight;

}  // namespace ergodome
