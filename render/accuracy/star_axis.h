#pragma once

#include <optional>

#include "render/accuracy/lens_race.h"

namespace ergodome {

//! The ways to find images of stars: by inverting the lens, and by what each pixel covers (VE). Nothing for a show without stars.
//!
//! Errors are distances of images from where they are exactly (exact_images), beside the error of their magnification; lost are images
//! that some method has found, exactly there, and another has not.
std::optional<AccuracyAxis> measure_stars(const Show& show, const std::vector<AccuracyMoment>& moments,
                                          const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
