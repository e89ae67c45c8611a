#pragma once

#include "kernels/lens/lens_grid.h"
#include "kernels/stars/search/bezier_patch.h"

namespace ergodome {

//! Returns the Bézier patch of a leaf of a lens grid: the sky direction, before normalization, as a
//! function of (u, v) along (γ, s).
BezierPatch bezier_patch(const LensGrid& grid, int leaf, float width_turns, float height);

}  // namespace ergodome
