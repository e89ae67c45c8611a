#pragma once

#include <vector>

#include "render/stars/star_finder.h"
#include "render/stars/star_refinement.h"

namespace ergodome {

//! Solid angle on the sky over that on the camera, no smaller than the star's disk allows: where the map is degenerate in one direction,
//! the image is an arc whose length the disk sets.
double capped_solid_angle(const StarCandidate& candidate);

//! An image with what tells it from another.
struct FoundImage {
  StarImage image;
  float arc;    //!< how far it stretches because its star is a disk [rad]
  bool capped;  //!< by its star's disk: which side it turns to means nothing
};

//! What a candidate has become.
FoundImage found_image(const StarImage& image, const StarCandidate& candidate);

//! The images there are, star by star, each once: neighbouring patches find those on their border twice, and the first of both is
//! taken. Stars are numbered below `stars`, that of an image which is none is -1. `pixel`: angle of a pixel [rad].
std::vector<StarImage> without_twins(const std::vector<FoundImage>& found, std::size_t stars, double pixel);

}  // namespace ergodome
