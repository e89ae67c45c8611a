#pragma once

#include "kernels/lens/lens_grid.h"
#include "kernels/stars/search/bezier_patch.h"

namespace ergodome {

//! The patch of a leaf of a lens grid: the sky direction over (u, v) along (γ, s), before it is normalized.
BezierPatch bezier_patch(const LensGrid& grid, int leaf, float width_turns, float height);

}  // namespace ergodome
