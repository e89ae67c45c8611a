#include <fmt/format.h>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::array guard_names = {"horizon", "photon_orbit"};
constexpr std::array start_names = {"path", "first_key"};

constexpr auto comfort_keys = keys_of<ComfortSettings>(
    key<&ComfortSettings::turn_deg_s>("turn_deg_s").range(0.1, 720.0).unit("deg/s").means("Fastest turn of the view."),
    key<&ComfortSettings::turn_accel_deg_s2>("turn_accel_deg_s2")
        .range(0.1, 7200.0)
        .unit("deg/s²")
        .means("Fastest change of the turning rate."),
    key<&ComfortSettings::accel>("accel")
        .range(0.01, 100.0)
        .unit("distances/s²")
        .means("Maximum acceleration, in distances to the guard per second squared."));

constexpr auto keys_of_flight = keys_of<FlightSettings>(
    key<&FlightSettings::guard>("guard")
        .words(guard_names)
        .means("The camera stays outside of it. `photon_orbit` means outside every circular orbit of light."),
    key<&FlightSettings::least_r>("least_r")
        .range(0.0, 1e8)
        .bounds("0 to 1e8, at most 0.9 `most_r`")
        .unit("M")
        .means("A guard farther out. 0: none."),
    key<&FlightSettings::most_r>("most_r")
        .range(5.0, 1e9)
        .unit("M")
        .after([](TomlTable& table, FlightSettings& flight) {
          if (!(flight.least_r <= 0.9 * flight.most_r)) {
            throw table.error_at("least_r", fmt::format("is {}, too close to most_r", flight.least_r),
                                 fmt::format("choose at most {:.6g}", 0.9 * flight.most_r));
          }
        })
        .means("Maximum radius."),
    key<&FlightSettings::mode>("mode").words(flight_mode_names).means("How free flight starts."),
    key<&FlightSettings::from>("from")
        .words(start_names)
        .means("Where free flight starts: at the show's camera, or at its first key."),
    key<&FlightSettings::max_speed>("max_speed")
        .range(0.001, 10.0)
        .unit("distances/s")
        .means("Maximum speed, in distances to the guard per second."),
    key<&FlightSettings::return_s>("return_s")
        .range(0.5, 60.0)
        .unit("s")
        .means("Duration of the flight back to the path. It is longer if comfort requires it."),
    table<&FlightSettings::comfort>("comfort", comfort_keys));

}  // namespace

constinit const KeyTable<FlightSettings> flight_keys = keys_of_flight;

}  // namespace ergodome
