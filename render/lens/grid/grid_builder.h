#pragma once

#include <optional>

#include "content/trajectory/lens_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/lens/grid/growing_grid.h"
#include "render/lens/stations/lens_position.h"

// Builds lens grids.

namespace ergodome {

//! Settings for building a lens grid.
struct GridSettings {
  double pixel = 7.67e-4;  //!< angle that a pixel of the screen subtends [rad]
  double budget_px = 0.1;  //!< maximum displacement of directions on the screen by the grid
  Aberration observer{};   //!< observer of the screen, from aberration_to_rain()
  //! Traces nodes in double precision; float is faster and suffices for budgets of 1e-5 rad and
  //! more.
  bool fine = true;
  //! Cells that cover a smaller area of the screen are not split: tracing their pixels is cheaper
  //! than tracing more nodes.
  double min_area_px = 32.0;
  //! Maximum number of nodes. When it is reached, the pixels of cells that still exceed the budget
  //! are left to direct rays.
  int max_nodes = 1 << 16;
  //! Also computes the derivatives of the nodes with respect to the camera's r and θ; the grid is
  //! then never mirrored.
  bool derivatives = false;
  //! If present, `derivatives` computes coefficients for a cell of camera positions instead
  //! (add_cell_motion()): half the extent of the cell along r [M] and θ [rad].
  std::optional<LensPosition> reach{};
  //! Fills LensStation::traced_nodes and leaf_displacements, which the search for star images
  //! needs.
  bool inverted = false;
  double range = 0.0;  //!< LensChart::range; 0: chosen from the budget, see chart_range()
};

//! Builds the lens grid of a camera at Boyer-Lindquist (r, θ) [M, rad], on either side of the
//! horizon.
//!
//! Checks each cell of the conforming chart against rays traced at the center of the cell and of
//! its sides. Splits the cell if the interpolated lens differs from these rays by more than 0.8 of
//! the budget, along the axis with the larger error. Cells that still exceed the budget at the
//! maximum depth or at `min_area_px` are flagged, and their pixels are traced. A node inside the
//! side of a larger cell gets the value interpolated along that side, so that the map and its
//! derivatives are continuous. For a camera on the equator (θ = π/2), only half of the grid is
//! built; it is mirrored when it is read.
//!
//! `tracer` traces float rays on its backend and keeps its memory for the next grid; without it
//! they are traced on the CPU.
LensStation build_lens_station(Spacetime spacetime, double r, double theta, const GridSettings& settings,
                               GridStatistics* statistics = nullptr, GridTracer<float>* tracer = nullptr);

//! Builds the grid of an ODS eye, over a chart centered on the eye's shadow in the view's axes. The
//! station is valid only for this eye, at any azimuth.
//!
//! `edge`: the shadow's edge [rad] around the chart's center, at equal steps of the position angle.
//! Rays are traced in float on the CPU; `settings.observer`, `settings.fine` and
//! `settings.derivatives` are ignored.
LensStation build_omni_station(const OmniCameraOf<float>& cameras, const ShadowChart& chart, std::vector<float> edge,
                               const GridSettings& settings, GridStatistics* statistics = nullptr);

//! Returns the LensChart::range that the chart of a position needs so that the grid extends to
//! within half the budget of the shadow's edge.
double chart_range(Spacetime spacetime, double r, double theta, const GridSettings& settings);

}  // namespace ergodome
