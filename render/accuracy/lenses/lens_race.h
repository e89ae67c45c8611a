#pragma once

#include <functional>
#include <vector>

#include "render/accuracy/lenses/pixel_lens.h"
#include "render/accuracy/measurement.h"

// Measures methods that find where pixels' light comes from.

namespace ergodome {

//! Receives a sentence about each step of the measurement. If it returns false, the measurement
//! stops with an Error.
using AccuracyProgress = std::function<bool(const std::string& doing)>;

//! Passes a sentence about a step to `progress`. Throws Error if the measurement must stop.
void report_progress(const AccuracyProgress& progress, const std::string& doing);

//! Measures methods that find where pixels' light comes from: their errors on the screen relative
//! to PixelReference, the change of these errors from frame to frame, and their times. Errors are
//! measured at one pixel of each cell of a lattice.
//!
//! Each method first draws one frame to warm up, and its errors are read. Then all methods are
//! prepared and draw in turn, round by round, so that other load on the machine affects all of
//! them. For short frames, one run is the fastest of three successive tries. Times are averaged
//! over the moments, round by round; errors of all moments form one set.
std::vector<Measurement> measure_lenses(const std::vector<LensChoiceToMeasure>& choices, PixelNeed need,
                                        const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                        const AccuracyProgress& progress);

//! Returns all methods that find where pixels' light comes from: integrators, tolerances,
//! precisions, grids, budgets and interpolations, including published ones. If `quick`, with fewer
//! settings and coarser quadtrees.
std::vector<LensChoiceToMeasure> sky_choices(bool quick);

//! Returns the renderer's methods for pictures whose filter needs the pixels' footprints on the
//! sky: direct rays, conforming grids, and quadtrees, which are coarser if `quick`.
std::vector<LensChoiceToMeasure> footprint_choices(bool quick);

}  // namespace ergodome
