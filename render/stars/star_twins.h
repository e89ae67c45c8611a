#pragma once

#include <vector>

#include "render/stars/star_finder.h"
#include "render/stars/star_refinement.h"

namespace ergodome {

//! Solid angle on the sky over that on the camera, no smaller than the star's disk allows: where the map is degenerate in one direction,
//! the image is an arc whose length the disk sets.
double capped_solid_angle(const StarCandidate& candidate);

//! The images there are, star by star, each once: neighbouring patches find those on their border twice. `found[i]` is what
//! `candidates[i]` has become, its star -1 where it is none; stars are numbered below `stars`. `pixel`: angle of a pixel [rad].
std::vector<StarImage> without_twins(const std::vector<StarImage>& found, const std::vector<StarCandidate>& candidates,
                                     std::size_t stars, double pixel);

}  // namespace ergodome
