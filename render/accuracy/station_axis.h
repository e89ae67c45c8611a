#pragma once

#include <optional>

#include "render/accuracy/lens_race.h"

namespace ergodome {

//! Whether a show's camera path can be baked, and has something to bake: see measure_stations.
bool has_stations(const Show& show);

//! Stations along a show's camera path: how far apart they may be when pictures between them are blended, with and without the stations'
//! derivatives. Nothing where the camera comes no nearer to the hole or its axis, nor farther, where the spin changes, and for the quadtree
//! scheme: such shows are not baked.
//!
//! Times and bytes are those of a second of the show: of the stations that it takes. A place half way between two is the worst.
std::optional<AccuracyAxis> measure_stations(const Show& show, const std::vector<AccuracyMoment>& moments,
                                             const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
