#pragma once

#include <filesystem>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Draws where choices of a report miss, as small PNGs in a folder, and puts their names into the report: for those that are on a Pareto
//! front, and for each method's cheapest within an error, or its most exact.
void draw_error_pictures(AccuracyReport& report, double most_px, const std::filesystem::path& folder);

//! The ends of the pictures' colours, which are logarithmic between [px].
inline constexpr double least_drawn_px = 1e-4;
inline constexpr double most_drawn_px = 10.0;
//! The same for light, of the picture's mean.
inline constexpr double least_drawn_light = 1e-5;
inline constexpr double most_drawn_light = 1.0;

}  // namespace ergodome
