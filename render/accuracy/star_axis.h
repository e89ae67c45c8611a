#pragma once

#include <optional>

#include "render/accuracy/lens_race.h"

namespace ergodome {

//! Measures the ways to find images of stars: by inverting the lens, and by gathering what each
//! pixel covers (VE). Returns nothing for a show without stars.
//!
//! Errors are distances of images from their exact positions (exact_images), with the errors of
//! their magnifications. Lost are images that one method finds, confirmed as exact, and the other
//! does not.
std::optional<AccuracyAxis> measure_stars(const Show& show, const std::vector<AccuracyMoment>& moments,
                                          const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
