#pragma once

#include <filesystem>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Draws error maps of the report's choices as small PNG files in a folder, and stores their names
//! in the report. Draws those on a Pareto front and, for each method, the cheapest choice with an
//! error (p99) of at most `max_px`, or 1 % for light; if it has none, its most exact one. Skips
//! choices whose map was not measured.
void draw_error_pictures(AccuracyReport& report, double max_px, const std::filesystem::path& folder);

//! Range of the logarithmic color scale of error pictures [px].
inline constexpr double min_drawn_px = 1e-4;
inline constexpr double max_drawn_px = 10.0;
//! Range of the logarithmic color scale of error pictures for light, relative to the mean of the
//! picture.
inline constexpr double min_drawn_light = 1e-5;
inline constexpr double max_drawn_light = 1.0;

}  // namespace ergodome
