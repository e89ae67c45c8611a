#pragma once

#include <vector>

#include "render/passes/stars/refinement/star_candidate.h"

namespace ergodome {

//! Refines image candidates by ray tracing, in single precision, and in double precision next to
//! caustics. A candidate is an image if its final `miss` is at most image_tolerance_px pixels.
//! Candidates that turn out to be too faint are dropped.
//!
//! The result for a candidate depends neither on other candidates nor on the number of threads.
void refine_images(std::vector<StarCandidate>& candidates, const ImageSearch& search);

}  // namespace ergodome
