#pragma once

#include <functional>
#include <vector>

#include "render/accuracy/measurement.h"
#include "render/accuracy/pixel_lens.h"

namespace ergodome {

//! Told of each piece of work that is done, by a sentence; false stops the measurement with an Error.
using AccuracyProgress = std::function<bool(const std::string& doing)>;

//! Throws Error when a measurement is to stop.
void go_on(const AccuracyProgress& progress, const std::string& doing);

//! Measures ways to find where pixels' light comes from: errors on the screen against PixelReference at one pixel of each cell of a lattice,
//! their change from a frame to the next, and times.
//!
//! Everything is drawn once to warm up, when errors are read. Then all are prepared and drawn in turn, round by round, so that a busy
//! minute of the machine is everybody's; of short ones the quickest of three in a row is a run. Times of several moments are averaged by round; errors of all moments are one set.
std::vector<Measurement> measure_lenses(const std::vector<LensChoiceToMeasure>& choices, PixelNeed need,
                                        const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                        const AccuracyProgress& progress);

//! All ways to find where pixels' light comes from: integrators, tolerances, precisions; grids, budgets, interpolations; the published ones
//! among them.
std::vector<LensChoiceToMeasure> sky_choices(bool quick);

//! Those that a renderer has for pictures whose filter needs footprints.
std::vector<LensChoiceToMeasure> footprint_choices(bool quick);

}  // namespace ergodome
