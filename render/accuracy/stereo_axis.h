#pragma once

#include <optional>

#include "render/accuracy/lens_race.h"

namespace ergodome {

//! The stereo models: what a pair of eyes costs by each, and where each shows things beside where the left one of two real eyes, a camera
//! each, would see them. Nothing for a show with a single eye.
//!
//! Times are those of both eyes' lenses, with the shadow's mask of the model `flat`; pixels are shaded elsewhere.
std::optional<AccuracyAxis> measure_stereo(const Show& show, PixelNeed need, const std::vector<AccuracyMoment>& moments,
                                           const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
