#pragma once

#include <optional>

#include "render/accuracy/lenses/lens_race.h"

// The axes along which a show is measured.

namespace ergodome {

//! Measures the filters of the sky's map. The reference integrates the map's light exactly over
//! parts of pixels.
AccuracyAxis measure_map(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures the ways to find lensed images of stars: by inverting the lens, and by gathering the
//! stars that each pixel covers (Verbraeck & Eisemann 2021). Returns nothing for a show without
//! stars.
//!
//! Errors are distances of images from their exact positions (exact_images()), and errors of their
//! magnifications. An image counts as lost by a method if only the other method finds it and
//! exact_images() confirms it.
std::optional<AccuracyAxis> measure_stars(const Show& show, const std::vector<AccuracyMoment>& moments,
                                          const AccuracySettings& settings, const AccuracyProgress& progress);

//! Returns whether stations apply to a show: the camera's r or θ changes, the spin is not animated,
//! and the grid scheme is conforming.
bool has_stations(const Show& show);

//! Measures how far apart stations on a show's camera path may be if the lens is blended between
//! them, with and without the stations' derivatives along the camera's r and θ. Returns nothing if
//! has_stations() is false, or if r and θ are constant at all moments.
//!
//! Times and disk sizes are totals over the stations that one second of the show needs; memory is
//! that of one station. Errors are measured halfway between two stations, where they are largest.
std::optional<AccuracyAxis> measure_stations(const Show& show, const std::vector<AccuracyMoment>& moments,
                                             const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures the stereo models: the cost of a pair of eyes, and the error of the left eye's image.
//! The reference is a pair of real eyes, each with its own camera. Returns nothing for a show with
//! a single eye, or if the baseline is 0 at all moments.
//!
//! Times are those of both eyes' lenses, including the shadow's mask of the model `flat`, without
//! shading.
std::optional<AccuracyAxis> measure_stereo(const Show& show, PixelNeed need, const std::vector<AccuracyMoment>& moments,
                                           const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures methods that draw disk, shells and objects, without the sky: rays, and for objects also
//! the published polygons if these can draw them. The show must have a disk, shells or objects.
AccuracyAxis measure_near(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Measures whole frames of the show for one eye: with direct rays, with the published quadtree
//! grid, and with live conforming grids of several budgets.
AccuracyAxis measure_frames(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
