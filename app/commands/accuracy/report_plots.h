#pragma once

#include <filesystem>
#include <string>

#include "render/accuracy/equal_error.h"

namespace ergodome {

//! gnuplot's words for the plot of an axis: error over time of a frame, a line a method, the choices that no other beats in rings.
std::string plot_script(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture);

//! Draws a plot as SVG by gnuplot. Tells whether there is a gnuplot; throws Error where it fails.
bool draw_plot(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture);

//! Whether a plot of an axis says something: it has two choices at least that took a time and missed by something.
bool is_plottable(const AccuracyAxis& axis);

}  // namespace ergodome
