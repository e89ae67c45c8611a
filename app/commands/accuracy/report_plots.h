#pragma once

#include <filesystem>
#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Returns the gnuplot script for the plot of an axis: error over frame time, one line per method,
//! with rings around the choices on the Pareto front.
std::string plot_script(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture);

//! Draws a plot as SVG with gnuplot. Returns false if gnuplot is not installed; throws Error if it
//! fails.
bool draw_plot(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture);

//! Returns whether the plot of an axis is useful: at least two choices have a time and an error.
bool is_plottable(const AccuracyAxis& axis);

}  // namespace ergodome
