#pragma once

#include <cstdint>

#include "kernels/stars/seen_image.h"

namespace ergodome {

//! Images that were found, an image on a border from both sides, to be put together star by star, each once. Arrays lie in the backend's memory.
struct StarTwinBatch {
  const SeenImage* found[2];  //!< in two pieces; those whose star is -1 are none
  int found_count[2];
  int star_count;
  double pixel;  //!< its angle [rad]
  std::int32_t*
      counts;  //!< of each star's images: zero before they are counted, and before their numbers are put in order
  const std::int32_t* first;  //!< of a star's numbers, and one more, where the last one's end
  std::int32_t* numbers;
  StarImage* images;  //!< as many as numbers, star by star; those that another has found as well have a star of -1
};

//! What is done one after another: images are counted by their stars, their numbers put into the stars' order by what `first` has then, and taken.
enum class StarTwinStep { count, number, take };

}  // namespace ergodome
