#pragma once

#include <vector>

#include "render/passes/stars/refinement/star_candidate.h"

namespace ergodome {

//! Refines images by ray tracing, in single precision and next to caustics in double. An image is
//! found if its final `miss` is at most image_tolerance_px pixels. Candidates that turn out to be
//! too faint are dropped.
//!
//! The result of a candidate depends neither on the others nor on the threads.
void refine_images(std::vector<StarCandidate>& candidates, const ImageSearch& search);

}  // namespace ergodome
