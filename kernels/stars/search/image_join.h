#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/stars/seen_image.h"

namespace ergodome {

//! Steps, run in this order: count the images of each star, list their numbers at the offsets in
//! `first`, and take each image once.
enum class ImageJoinStep { count, number, take };

//! Order in which the images of a star are kept. Of an image that was found twice, the first is
//! kept.
enum class ImageOrder {
  as_found,
  by_position  //!< sorted by direction, for images that were found in nondeterministic order
};

//! Collects images star by star. An image on a border may have been found from both sides, and is
//! kept once. Arrays lie in the backend's memory.
struct ImageJoinBatch {
  const SeenImage* found[2];  //!< images found, in two arrays; entries with a star of -1 are unused
  int found_count[2];
  int star_count;
  double pixel;  //!< angle that a pixel of the picture subtends [rad]
  ImageOrder order;
  //! Number of images of each star; must be zero before the steps `count` and `number`.
  std::int32_t* counts;
  const std::int32_t* first;  //!< index in `numbers` of each star's images; star_count + 1 elements
  std::int32_t* numbers;
  //! Images, star by star, one for each element of `numbers`; duplicates have a star of -1.
  StarImage* images;
  ImageJoinStep step = ImageJoinStep::count;
};

template <>
struct Kernel<ImageJoinBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr bool compiled_once = true;
  static constexpr bool counted = false;
  static const char* name(const ImageJoinBatch& /*batch*/) { return "join_star_images"; }
  static int elements(const ImageJoinBatch& batch) {
    return batch.step == ImageJoinStep::take ? batch.star_count : batch.found_count[0] + batch.found_count[1];
  }
};

}  // namespace ergodome
