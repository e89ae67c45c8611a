#pragma once

#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/lens/look_up.h"
#include "render/lens/stations/lens_position.h"

// Measures the error of a lens on an observer's screen.

namespace ergodome {

//! The observer of a lens: position, velocity (as an aberration) and screen.
struct LensView {
  Spacetime spacetime;
  LensPosition position;
  Aberration observer;  //!< aberration of the observer, from aberration_to_rain()
  double pixel;         //!< angle that a pixel of the observer's screen subtends [rad]
  double share = 1.0;   //!< fraction of all directions that the screen shows
};

//! Sample points in the conforming chart; each represents an area of the chart.
struct ChartSamples {
  std::vector<double> gamma_turns;
  std::vector<double> s;
  //! Area of the chart that each point represents, in γ [turns] times s.
  std::vector<double> extent;
};

//! Returns 4 to 64 sample points in each leaf of a station, about ten thousand or more in all. They
//! are denser where leaves are smaller, whatever the observer. For a mirrored station, also returns
//! their mirror images.
ChartSamples leaf_samples(const LensStation& station);

//! Returns sample points, ten thousand or more in all, that are so dense in each leaf of `station`
//! that none represents a large part of an observer's sky. `chart` is that of the observer's
//! position. Fast observers see a few leaves magnified over the whole screen, where one point per
//! leaf would not resolve the error of one percent of the sky.
ChartSamples screen_samples(const LensStation& station, const LensChart& chart, const LensView& view);

//! Returns a lattice of sample points over the whole chart, for a quick check of any lens.
ChartSamples lattice_samples(int columns, int rows);

//! Quantiles of a lens's error [px], by solid angle of the observer's sky: the 99 % quantile on the
//! screen for its worst orientation, and the 99.9 % quantile of the whole sky.
struct ScreenError {
  double p99_px;
  double p999_px;
};

//! Computes the quantiles from errors [px] at sample points and the areas that these represent on
//! the screen [px²]. A `share` below a tenth of the sky counts as a tenth.
ScreenError bounds_of(const std::vector<double>& error_px, const std::vector<double>& area_px, double share = 1.0);

//! Compares a lens, whose arrays are in host memory, with rays traced in double precision at the
//! sample points. Pixels that the lens leaves to direct rays count as exact.
ScreenError measure_screen_error(const LensBlend& lens, const LensView& view, const ChartSamples& samples);

}  // namespace ergodome
