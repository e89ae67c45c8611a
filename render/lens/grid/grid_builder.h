#pragma once

#include "content/trajectory/lens_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/lens/grid/growing_grid.h"

namespace ergodome {

//! What a lens grid is built for.
struct GridSettings {
  double pixel = 7.67e-4;       //!< angle of a pixel on the screen [rad]
  double budget_px = 0.1;       //!< greatest displacement on the screen
  Aberration observer{};        //!< whose screen: from aberration_to_rain()
  bool fine = true;             //!< nodes traced in double; float is faster and good for budgets of 1e-5 rad and more
  double least_area_px = 32.0;  //!< a cell smaller than this is not split: tracing its pixels is cheaper than its nodes
  int most_nodes = 1 << 16;     //!< what is bad still when there are so many is left to direct rays
  bool derivatives = false;     //!< also how the nodes change along r and θ; the grid is then never mirrored
  bool inverted = false;        //!< images of stars are sought in it: what LensStation keeps for these
  double range = 0.0;           //!< of the chart; 0: what the budget asks for at the place, see chart_range()
};

//! Builds the lens grid of a camera at Boyer-Lindquist (r, θ) [M, rad], outside the horizon.
//!
//! Cells of the conforming chart are split where traced rays in their middles and the middles of their sides miss the patch by more
//! than 0.8 of the budget, along the axis that misses more. What stays bad at the depth limit or at `least_area_px` is flagged: its
//! pixels are to be traced. Nodes in the middle of a larger cell's side then take that side's values, so that the map and its
//! derivatives are continuous. A camera on the equator (θ = π/2) gets half a grid, mirrored on reading.
//!
//! `tracer` says where rays in float are traced, and keeps its memory for the next grid; without one it is the processor.
LensStation build_lens_station(double spin, double r, double theta, const GridSettings& settings,
                               GridStatistics* statistics = nullptr, GridTracer<float>* tracer = nullptr);

//! The same for an eye that turns with the direction one looks at, over a chart about the shadow that it sees, in the view's axes.
//!
//! `edge`: the shadow's edge about the chart's centre at equal steps of the position angle [rad]. Rays are in float, on the processor;
//! `settings.observer`, `settings.fine` and `settings.derivatives` mean nothing. The station serves this eye alone, at any azimuth.
LensStation build_omni_station(const OmniCameraOf<float>& cameras, const ShadowChart& chart, std::vector<float> edge,
                               const GridSettings& settings, GridStatistics* statistics = nullptr);

//! The range that the chart of a place needs: down to half the budget from the shadow's edge.
double chart_range(double spin, double r, double theta, const GridSettings& settings);

}  // namespace ergodome
