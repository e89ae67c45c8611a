#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "content/trajectory/lens_station.h"

namespace ergodome {

//! Whether a file begins as trajectories do, finished or not.
bool is_trajectory(const std::filesystem::path& file);

//! Throws Error where a trajectory is not there, but a bake of it that was stopped.
void require_finished_trajectory(const std::filesystem::path& file);

//! What is in a trajectory: its provenance, its stations, and which of them cannot be read. All of them are read.
nlohmann::json facts_of_trajectory(const std::filesystem::path& file);

void print_trajectory(const nlohmann::json& facts);

//! The last station at a show time or before.
LensStation station_of_trajectory(const std::filesystem::path& file, double time_s);

}  // namespace ergodome
