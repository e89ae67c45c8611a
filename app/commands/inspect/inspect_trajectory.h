#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "content/trajectory/lens_station.h"

namespace ergodome {

//! Returns whether a file begins like a trajectory, finished or not.
bool is_trajectory(const std::filesystem::path& file);

//! Throws Error if a trajectory is missing but the journal of an interrupted bake exists.
void require_finished_trajectory(const std::filesystem::path& file);

//! Reads all stations of a trajectory and returns a summary: its provenance, its stations, and
//! which of them are damaged.
nlohmann::json summary_of_trajectory(const std::filesystem::path& file);

void print_trajectory(const nlohmann::json& summary);

//! Reads the last station at or before a show time [s]. Throws UsageError if the time is outside
//! the trajectory.
LensStation station_of_trajectory(const std::filesystem::path& file, double time_s);

}  // namespace ergodome
