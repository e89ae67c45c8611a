#pragma once

#include "kernels/projection/projection.h"
#include "render/passes/effects/bloom.h"

namespace ergodome {

//! Scatters light in place as add_bloom does, and across the seams of the projection: from one side of a picture that goes all the way
//! round to the other, and from each face of a cube to its neighbours.
//!
//! A face is widened by three radii, its own width at the most, with what lies beside it on the plane of the face, so that halos of both
//! sides meet at an edge; memory: the picture's and a widened face's on top.
void add_bloom(Picture& picture, const Projection& projection, const BloomSettings& settings);

}  // namespace ergodome
