#pragma once

#include "calibration/pfm.h"
#include "calibration/warp_mesh.h"

namespace ergodome {

//! How far positions between the samples of a thinned map may be off [px of the projector].
inline constexpr double thinned_error_px = 0.05;

//! How far a map is off [px of the projector]: the worst of the drawn pixels that see the domemaster's circle, by bilinear interpolation
//! and by triangles. Infinite where the map does not draw such a pixel. `exact` has a node for each pixel of the raster. Stops at the
//! first pixel that is off by more than `enough_px`.
double map_error_px(const WarpMesh& exact, const FloatMap& map, double enough_px);

//! A map of a warp with texture coordinates downwards and a sample for 8 x 8, 4 x 4 or 2 x 2 pixels of the raster: as few as keep it
//! within thinned_error_px, else a sample for each pixel. No coarser, as programs differ in how they read the half cell at the rim, and
//! there a cell of 8 pixels leaves four. `exact` is the warp with a node for each pixel.
FloatMap thinned_map(const WarpMesh& warp, const WarpMesh& exact);

}  // namespace ergodome
