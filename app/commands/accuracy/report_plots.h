#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! The choices of one method in one precision: a line of a plot, and an entry of its numbered
//! legend.
struct ReportSeries {
  int number = 0;  //!< from 1; the same in plot, legend and table
  std::string name;
  std::string colour;  //!< "#009e73"
  bool published = false;
  std::vector<const Measurement*> choices;
};

//! Returns the series of an axis in the order of its choices. They point to choices of the axis,
//! which must outlive them.
std::vector<ReportSeries> series_of(const AccuracyAxis& axis);

//! Returns the gnuplot script that draws the plot of an axis to the SVG file `picture`: error (p99)
//! over frame time, one line per series_of(), with rings around the choices on the Pareto front.
std::string plot_script(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture);

//! Draws a plot as SVG with gnuplot. Returns false if gnuplot is not installed; throws Error if it
//! fails.
bool draw_plot(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture);

//! Returns whether the plot of an axis is useful: at least two choices have a time and a finite
//! error.
bool is_plottable(const AccuracyAxis& axis);

}  // namespace ergodome
