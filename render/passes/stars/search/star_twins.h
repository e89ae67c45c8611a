#pragma once

#include <vector>

#include "render/passes/stars/search/star_candidate.h"
#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Solid angle on the sky over that on the camera, no smaller than the star's disk allows: where the map is degenerate in one direction,
//! the image is an arc whose length the disk sets.
double capped_solid_angle(const StarCandidate& candidate);

//! What a candidate has become.
SeenImage seen_image(const StarImage& image, const StarCandidate& candidate);

//! In which order images were found.
enum class FindingOrder { of_patches, of_chance };

//! The images there are, star by star, each once: neighbouring patches find those on their border twice, and the first of both is
//! taken; where chance ordered them, that which is first by its place. Stars are numbered below `stars`, that of an image which is none is -1.
//! `pixel`: angle of a pixel [rad].
std::vector<StarImage> without_twins(const std::vector<SeenImage>& found, std::size_t stars, double pixel,
                                     FindingOrder order);

}  // namespace ergodome
