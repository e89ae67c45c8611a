#pragma once

#include <array>

#include "render/accuracy/lenses/lens_race.h"

// Measures cost and accuracy of several ways to render a show.

namespace ergodome {

//! Names of all axes, in the order of reports. An axis is a choice that a show leaves open, for
//! example the lens grid; an AccuracyAxis compares the options of one choice.
inline constexpr std::array accuracy_axis_names = {"rays", "lens",  "stations", "stereo",
                                                   "map",  "stars", "near",     "frame"};

//! Returns the names of the requested axes that apply to a show.
//!
//! `rays`, `map` and `frame` always apply; `lens` if the map's filter needs footprints; `stations`
//! if the camera's r or θ changes, the spin is constant and the grid scheme is conforming; `stereo`
//! with two eyes; `stars` if the show has stars; `near` if it has a disk, shells or objects.
//! Exception: with settings.quick, shows with objects have neither `near` nor `frame`.
std::vector<std::string> accuracy_axes(const Show& show, const AccuracySettings& settings);

//! Measures, on this machine's CPU and for a show, what each degree of accuracy costs, along each
//! axis that applies.
//!
//! Throws Error if the show cannot be drawn or `progress` stops the measurement.
AccuracyReport measure_accuracy(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Returns the settings of `ergodome accuracy --quick`.
AccuracySettings quick_settings();

}  // namespace ergodome
