#pragma once

#include <array>

#include "render/accuracy/lens_race.h"

namespace ergodome {

//! Names of all axes, in the order of reports.
inline constexpr std::array accuracy_axis_names = {"rays", "lens",  "stations", "stereo",
                                                   "map",  "stars", "near",     "frame"};

//! The choices that a show leaves: names of axes, of those that are asked for.
//!
//! `lens` where the map's filter asks for footprints; `stations` where the camera comes nearer to the hole or its axis, or goes farther, and
//! the spin stays, and the grid is one that is baked; `stars` where it has any.
std::vector<std::string> accuracy_axes(const Show& show, const AccuracySettings& settings);

//! Measures what accuracy costs in time, on this machine, for a show: along each choice that the show leaves, and no other.
//!
//! Throws Error where the show cannot be drawn, or progress says stop.
AccuracyReport measure_accuracy(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! What `--quick` stands for.
AccuracySettings quick_settings();

}  // namespace ergodome
