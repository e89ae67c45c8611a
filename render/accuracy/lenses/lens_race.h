#pragma once

#include <functional>
#include <vector>

#include "render/accuracy/lenses/pixel_lens.h"
#include "render/accuracy/measurement.h"

// Measures methods that find where pixels' light comes from.

namespace ergodome {

//! Receives a sentence about each step of the measurement; returning false stops it with an Error.
using AccuracyProgress = std::function<bool(const std::string& doing)>;

//! Reports a step. Throws Error if the measurement must stop.
void go_on(const AccuracyProgress& progress, const std::string& doing);

//! Measures methods that find where pixels' light comes from: errors on the screen against
//! PixelReference at one pixel of each cell of a lattice, their change from frame to frame, and
//! times.
//!
//! Each method first draws once to warm up, and its errors are read. Then all are prepared and
//! drawn in turn, round by round, so that other load on the machine affects all of them; for short
//! frames the fastest of three in a row is one run. Times of several moments are averaged by round;
//! errors of all moments form one set.
std::vector<Measurement> measure_lenses(const std::vector<LensChoiceToMeasure>& choices, PixelNeed need,
                                        const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                        const AccuracyProgress& progress);

//! Returns all methods that find where pixels' light comes from: integrators, tolerances,
//! precisions, grids, budgets and interpolations, including published ones.
std::vector<LensChoiceToMeasure> sky_choices(bool quick);

//! Returns the methods that a renderer has for pictures whose filter needs footprints.
std::vector<LensChoiceToMeasure> footprint_choices(bool quick);

}  // namespace ergodome
