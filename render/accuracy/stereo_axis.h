#pragma once

#include <optional>

#include "render/accuracy/lens_race.h"

namespace ergodome {

//! Measures the stereo models: the cost of a pair of eyes, and the displacement of things from
//! where the left one of two real eyes, each with its own camera, would see them. Returns nothing
//! for a show with a single eye.
//!
//! Times are those of both eyes' lenses, including the shadow's mask of the model `flat`, without
//! shading.
std::optional<AccuracyAxis> measure_stereo(const Show& show, PixelNeed need, const std::vector<AccuracyMoment>& moments,
                                           const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
