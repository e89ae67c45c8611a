#pragma once

#include <vector>

#include "render/passes/stars/search/star_candidate.h"

namespace ergodome {

//! Follows images to where rays have them: in float, and in double next to caustics. An image is found when its `miss` is at most
//! image_tolerance_px pixels. What turns out too faint on the way is left.
//!
//! What becomes of a candidate hangs on no other, nor on threads.
void refine_images(std::vector<StarCandidate>& candidates, const ImageSearch& search);

}  // namespace ergodome
