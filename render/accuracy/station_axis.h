#pragma once

#include <optional>

#include "render/accuracy/lens_race.h"

namespace ergodome {

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

}  // namespace ergodome
