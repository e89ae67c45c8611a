#pragma once

#include "content/trajectory/lens_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/lens/grid/growing_grid.h"

// Builds lens grids.

namespace ergodome {

//! Settings for building a lens grid.
struct GridSettings {
  double pixel = 7.67e-4;  //!< angle of a pixel on the screen [rad]
  double budget_px = 0.1;  //!< maximum displacement on the screen
  Aberration observer{};   //!< observer of the screen, from aberration_to_rain()
  //! Trace nodes in double; float is faster and suffices for budgets of 1e-5 rad and more.
  bool fine = true;
  //! Smaller cells are not split: tracing their pixels is cheaper than tracing nodes.
  double least_area_px = 32.0;
  //! At this many nodes, cells that still miss the budget are left to direct rays.
  int most_nodes = 1 << 16;
  //! Also compute how the nodes change along r and θ; the grid is then never mirrored.
  bool derivatives = false;
  //! Keep the data of LensStation that a search for images of stars needs.
  bool inverted = false;
  double range = 0.0;  //!< of the chart; 0: chosen from the budget, see chart_range()
};

//! Builds the lens grid of a camera at Boyer-Lindquist (r, θ) [M, rad], outside the horizon.
//!
//! Splits cells of the conforming chart where the patch differs from rays traced in the middle of
//! the cell and of its sides by more than 0.8 of the budget, along the axis with the larger error.
//! Cells that still miss the budget at the depth limit or at `least_area_px` are flagged, and their
//! pixels are traced. Nodes inside a larger cell's side take that side's values, so that the map
//! and its derivatives are continuous. A camera on the equator (θ = π/2) gets half a grid, mirrored
//! on reading.
//!
//! `tracer` traces float rays on its backend and keeps its memory for the next grid; without it
//! they are traced on the CPU.
LensStation build_lens_station(Spacetime spacetime, double r, double theta, const GridSettings& settings,
                               GridStatistics* statistics = nullptr, GridTracer<float>* tracer = nullptr);

//! Builds the grid of an ODS eye, over a chart about its shadow in the view's axes. The station
//! serves this eye alone, at any azimuth.
//!
//! `edge`: the shadow's edge [rad] about the chart's center, at equal steps of the position angle.
//! Rays are traced in float on the CPU; `settings.observer`, `settings.fine` and
//! `settings.derivatives` are ignored.
LensStation build_omni_station(const OmniCameraOf<float>& cameras, const ShadowChart& chart, std::vector<float> edge,
                               const GridSettings& settings, GridStatistics* statistics = nullptr);

//! Returns the chart range needed at a position, which reaches to within half the budget of the
//! shadow's edge.
double chart_range(Spacetime spacetime, double r, double theta, const GridSettings& settings);

}  // namespace ergodome
