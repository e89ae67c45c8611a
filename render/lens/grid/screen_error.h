#pragma once

#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/lens/look_up.h"
#include "render/lens/stations/place_turn.h"

namespace ergodome {

//! Who looks at a lens, where, and how closely.
struct LensView {
  double spin;  //!< [M]
  LensPlace place;
  Aberration observer;  //!< from aberration_to_rain()
  double pixel;         //!< angle of a pixel on the observer's screen [rad]
  double share = 1.0;   //!< of the sky that the screen shows, which may be where the error is
};

//! Places of the conforming chart, each standing for a part of it.
struct ChartSamples {
  std::vector<double> gamma_turns;
  std::vector<double> s;
  std::vector<double> extent;  //!< turns times s
};

//! Places in each of a station's leaves, so dense where its map needs them, whoever looks; some ten thousand or more in all. A mirrored station's
//! stand for both halves of the sky.
ChartSamples leaf_samples(const LensStation& station);

//! Places so dense in each leaf of a lens's station that none stands for much of what an observer sees, whose place has a chart of its own; some ten thousand
//! or more in all. Who moves fast sees a few leaves all over the screen: one place in each would tell little of what a hundredth of the sky is missed by.
ChartSamples screen_samples(const LensStation& station, const LensChart& chart, const LensView& view);

//! A lattice over the whole chart, for a quick look at any lens.
ChartSamples lattice_samples(int columns, int rows);

//! What a lens misses by: bounds for all but a hundredth of what a screen shows, wherever it looks, and for all but a thousandth of the sky that the
//! observer sees, by solid angle [px].
struct ScreenError {
  double p99_px;
  double p999_px;
};

//! Those bounds from errors [px] at places, and the areas on the screen that these stand for [px²]; of screens that show less than a tenth of the sky, the
//! first is that of one that shows as much.
ScreenError bounds_of(const std::vector<double>& error_px, const std::vector<double>& area_px, double share = 1.0);

//! Compares a lens (its arrays on the host) with rays traced in double at the samples. What the lens leaves to rays counts as exact.
ScreenError measure_screen_error(const LensBlend& lens, const LensView& view, const ChartSamples& samples);

}  // namespace ergodome
