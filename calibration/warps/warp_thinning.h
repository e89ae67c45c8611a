#pragma once

#include "calibration/warps/pfm.h"
#include "calibration/warps/warp_mesh.h"

namespace ergodome {

//! Maximum error between the samples of a thinned map [px of the projector].
inline constexpr double thinned_error_px = 0.05;

//! Returns the maximum deviation of a map from the warp `exact` [px of the projector], for bilinear
//! and for triangular interpolation, at the drawn pixels that show the domemaster's circle.
//! Infinite if the map does not draw such a pixel. Stops at the first pixel with a deviation above
//! `enough_px`. `exact` has a node for each pixel of the raster.
double map_error_px(const WarpMesh& exact, const FloatMap& map, double enough_px);

//! Returns a map of a warp, with texture coordinates downward, that has a sample for 8 x 8, 4 x 4
//! or 2 x 2 pixels of the raster: the coarsest with an error of at most thinned_error_px, otherwise
//! one with a sample for each pixel. Coarser maps are not used, because programs interpret the half
//! cell at the edge differently, which is four pixels wide for 8 x 8. `exact` is the warp with a
//! node for each pixel.
FloatMap thinned_map(const WarpMesh& warp, const WarpMesh& exact);

}  // namespace ergodome
