#pragma once

#include "kernels/projection/projection.h"
#include "render/passes/effects/bloom.h"

namespace ergodome {

//! Scatters light in place as add_bloom does, including across the seams of the projection: between
//! the sides of a picture that wraps around, and between adjacent faces of a cube.
//!
//! Each face is widened by three radii (at most its width) with its surroundings projected to its
//! plane, so that halos match at the edges. Needs memory for another picture and a widened face.
void add_bloom(Picture& picture, const Projection& projection, const BloomSettings& settings);

}  // namespace ergodome
