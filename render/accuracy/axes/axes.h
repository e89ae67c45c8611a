#pragma once

#include <optional>

#include "render/accuracy/lenses/lens_race.h"

// The axes along which a show is measured.

namespace ergodome {

//! Compares the filters of the sky's map with the light integrated exactly over parts of pixels.
AccuracyAxis measure_map(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures the ways to find images of stars: by inverting the lens, and by gathering what each
//! pixel covers (VE). Returns nothing for a show without stars.
//!
//! Errors are distances of images from their exact positions (exact_images), with the errors of
//! their magnifications. Lost are images that one method finds, confirmed as exact, and the other
//! does not.
std::optional<AccuracyAxis> measure_stars(const Show& show, const std::vector<AccuracyMoment>& moments,
                                          const AccuracySettings& settings, const AccuracyProgress& progress);

//! Returns whether a show's camera path can be baked and needs stations: see measure_stations.
bool has_stations(const Show& show);

//! Measures how far apart stations on a show's camera path may be if pictures between them are
//! blended, with and without the stations' derivatives. Returns nothing for shows that are not
//! baked: the camera's r and θ are constant, the spin changes, or the grid scheme is quadtree.
//!
//! Times and bytes are those of the stations for one second of the show. Errors are measured
//! halfway between two stations, where they are largest.
std::optional<AccuracyAxis> measure_stations(const Show& show, const std::vector<AccuracyMoment>& moments,
                                             const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures the stereo models: the cost of a pair of eyes, and the displacement of things from
//! where the left one of two real eyes, each with its own camera, would see them. Returns nothing
//! for a show with a single eye.
//!
//! Times are those of both eyes' lenses, including the shadow's mask of the model `flat`, without
//! shading.
std::optional<AccuracyAxis> measure_stereo(const Show& show, PixelNeed need, const std::vector<AccuracyMoment>& moments,
                                           const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures disk, shells and objects alone: with rays, and objects also with the published polygons
//! if these can draw them. The show must have some.
AccuracyAxis measure_near(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures whole frames of the show with each source of the lens.
AccuracyAxis measure_frames(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
