#pragma once

#include <vector>

#include "render/passes/stars/search/star_candidate.h"
#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Returns the ratio of the solid angles on the sky and on the camera, bounded below by the star's
//! disk: where the map is degenerate in one direction, the image is an arc whose length depends on
//! the disk.
double capped_solid_angle(const StarCandidate& candidate);

//! Combines an image with the properties of its candidate that are needed to identify duplicates.
SeenImage seen_image(const StarImage& image, const StarCandidate& candidate);

//! Order in which images were found.
enum class FindingOrder { of_patches, of_chance };

//! Returns each image once, ordered by star. Neighboring patches both find images on their border;
//! the first one is kept, or in nondeterministic order the one with the first position. Star
//! indices are below `stars`, or -1 for unused entries. `pixel`: angle of a pixel [rad].
std::vector<StarImage> without_twins(const std::vector<SeenImage>& found, std::size_t stars, double pixel,
                                     FindingOrder order);

}  // namespace ergodome
